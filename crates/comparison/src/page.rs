//! docs/benchmarks.md: the tables as a page, and whether the page still has the form of what this
//! program prints.

const INTRO: &str = "# Benchmarks\n\nWritten by `cargo bench --bench compare -- --page \
                     docs/benchmarks.md` (`--python` names a Python with SciPy and \
openseespy; with `--quick` other programs are left out). Times depend on the machine and count as \
                     ratios; errors do not.\n\n";

/// The page.
pub fn page(text: &str) -> String {
    let mut out = INTRO.to_string();
    let lines: Vec<&str> = text.lines().collect();
    for (i, line) in lines.iter().enumerate() {
        // the title of a table stands two lines above it
        if lines.get(i + 2).is_some_and(|next| next.starts_with('|'))
            && line.chars().next().is_some_and(|c| c != '|')
        {
            out.push_str("\n## ");
            out.push_str(line);
        } else {
            out.push_str(line.trim_end());
        }
        out.push('\n');
    }
    while out.contains("\n\n\n") {
        out = out.replace("\n\n\n", "\n\n");
    }
    out
}

/// Whether a page has every title and every head of a table that `text` has; it may have more, as
/// what other programs need.
pub fn check(text: &str, there: &str) -> Result<(), String> {
    let form = |page: &str| -> Vec<String> {
        let lines: Vec<&str> = page.lines().collect();
        let head = |(i, line): (usize, &&str)| {
            let rule =
                |next: &&str| next.starts_with('|') && next.chars().all(|c| "|-: ".contains(c));
            (line.starts_with("## ") || lines.get(i + 1).is_some_and(rule)).then(|| words(line))
        };
        lines.iter().enumerate().filter_map(head).collect()
    };
    let there = form(there);
    match form(&page(text)).into_iter().find(|line| !there.contains(line)) {
        None => Ok(()),
        Some(line) => Err(format!("no \"{line}\" on the page; write it anew with --page")),
    }
}

/// A line without the widths of its columns.
fn words(line: &str) -> String {
    line.split_whitespace().collect::<Vec<_>>().join(" ")
}

#[cfg(test)]
mod tests {
    use super::*;

    const TEXT: &str = "Run time.\n\nThe tool\n\n| a | b |\n|---|---|\n| 1 | 2 |\n";

    #[test]
    fn a_page_has_the_form_of_its_text_whatever_the_numbers_and_widths() {
        let text = page(TEXT);
        assert!(text.contains("\n\n## The tool\n\n| a | b |"), "{text}");
        assert_eq!(
            check(TEXT, &text.replace("| 1 |", "| 7 |").replace("| a |", "|  a  |")),
            Ok(())
        );
    }

    #[test]
    fn a_missing_column_is_told() {
        let other = page(TEXT).replace("| a | b |", "| a |");
        assert!(check(TEXT, &other).unwrap_err().contains("| a | b |"));
    }
}
