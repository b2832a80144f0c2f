//! The formats that are read, in the words of every text that lists them.

use std::{fs, path::Path};

use strong_motion::RecordFormat;

/// What tells users which formats there are.
const TEXTS: [&str; 8] = [
    "README.md",
    "src/commands/init.rs",
    "src/commands/common.rs",
    "crates/web/page/index.html",
    "python/src/record.rs",
    "python/groundspring/_native.pyi",
    "crates/strong-motion/src/error.rs",
    "crates/strong-motion/src/lib.rs",
];
/// A list of all formats is no longer (letters).
const LIST: usize = 200;

#[test]
fn every_text_that_lists_the_formats_names_them_all() {
    let first = RecordFormat::Peer.to_string();
    for path in TEXTS {
        let text = fs::read_to_string(Path::new(env!("CARGO_MANIFEST_DIR")).join(path)).unwrap();
        // a list may go over several lines of a comment
        let words: Vec<&str> = text.split_whitespace().filter(|word| *word != "//!").collect();
        let text = words.join(" ");
        let lists: Vec<String> = text
            .match_indices(&first)
            .map(|(at, _)| text[at..].chars().take(LIST).collect())
            .collect();
        let names = |list: &str, format: RecordFormat| {
            // of names with a stroke the first is enough
            format.to_string().split('/').next().is_some_and(|name| list.contains(name))
        };
        let missing = |list: &String| RecordFormat::ALL.into_iter().find(|f| !names(list, *f));
        let missing: Vec<_> = lists.iter().map(missing).collect();
        assert!(missing.contains(&None), "{path}: its list lacks {missing:?}");
    }
}
