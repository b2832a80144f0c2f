//! The model for other programs: decks for OpenSees (Python and Tcl), and k1, k2, m2, c for
//! everyone else.
//!
//! ```sh
//! cargo run --release --example export -- decks       # a folder; one in the temporary folder unless given
//! python3 decks/model.py                              # with openseespy: builds, runs, compares its peaks with ours
//! ```

use std::path::PathBuf;

use groundspring::{Case, DeckFormat, Record, Structure, deck, tune};

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let folder =
        std::env::args().nth(1).map_or_else(|| std::env::temp_dir().join("decks"), PathBuf::from);
    std::fs::create_dir_all(&folder)?;

    // a pier, on the first ten seconds of El Centro
    let record = Record::el_centro().truncated(10.0);
    let case = Case::of(Structure::a_frame(20.0, 4.0, 1e5)?, record)?;
    let springs = tune(&case)?;

    for (name, format) in [
        ("model.py", DeckFormat::OpenSeesPy),
        ("model.tcl", DeckFormat::OpenSeesTcl),
        ("springs.csv", DeckFormat::Csv),
        ("springs.md", DeckFormat::Markdown),
    ] {
        // every deck holds our own history's peaks, and checks itself against them when it runs
        let text = deck(&springs, &case.record, format)?;
        let path = folder.join(name);
        std::fs::write(&path, &text)?;
        println!("{}: {} lines", path.display(), text.lines().count());
    }
    Ok(())
}
