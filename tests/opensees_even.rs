//! Decks of steps of one size in OpenSees itself, beside the emulation that their springs were
//! judged by. Run as `tests/opensees`:
//! `cargo test --release --test opensees_even -- --ignored --nocapture`.

use std::process::Command;

#[path = "support/program.rs"]
mod program;

use program::tune;

/// The interpreter of a format, as words: Tcl's only where it is named.
fn interpreter(format: &str) -> Option<Vec<String>> {
    let variable = |name: &str| std::env::var(name).ok().filter(|value| !value.is_empty());
    match format {
        "openseespy" => Some(vec![variable("OPENSEES_PYTHON").unwrap_or_else(|| "python3".into())]),
        _ => variable("OPENSEES_TCL")
            .map(|words| words.split_whitespace().map(str::to_string).collect()),
    }
}

/// Decks of even steps and of substeps at touches end within 1 % of what our emulation found, which
/// they check by themselves, in Python and in Tcl; a block, a frame, three integrators.
#[test]
#[ignore = "needs OpenSees, which cargo cannot install; .ci/run installs it and runs this"]
fn decks_of_even_steps_find_what_the_emulation_found() {
    let folder = tempfile::tempdir().unwrap();
    let run = |args: &[&str]| {
        let out = tune(folder.path(), args);
        assert!(out.status.success(), "{args:?}: {}", String::from_utf8_lossy(&out.stderr));
    };
    let block = "[structure]\nkind = 'block'\ntotal_height_m = 4.0\nwidth_m = 1.2\nmass_kg = 4e3\n\
                 [record]\nscale = 1.8\n";
    std::fs::write(folder.path().join("block.toml"), block).unwrap();
    std::fs::write(
        folder.path().join("frame.toml"),
        "[structure]\nkind = 'aframe'\nheight_m = 20.0\nwidth_m = 4.4\nmass_kg = 2e5\n",
    )
    .unwrap();
    // the block's history can be predicted for part of its 20 s; its decks compare as much; 1.5 ms
    // is no part of the record's step
    for (case, integrator, duration, step) in [
        ("block.toml", "trbdf2", "20", "0.001"),
        ("frame.toml", "hht:-0.3333333333333333", "12", "0.001"),
        ("frame.toml", "backward-euler", "12", "0.0015"),
    ] {
        run(&[
            "run",
            case,
            "--quiet",
            "--no-figures",
            "--no-report",
            "--duration",
            duration,
            "--step",
            step,
            "--integrator",
            integrator,
        ]);
        for (stepping, format) in [
            ("even", "openseespy"),
            ("touches", "openseespy"),
            ("even", "opensees-tcl"),
            ("touches", "opensees-tcl"),
        ] {
            run(&[
                "export",
                "--parameters",
                "out/parameters.json",
                "--format",
                format,
                "--stepping",
                stepping,
                "--out",
                "deck",
            ]);
            let Some(program) = interpreter(format) else { continue };
            let name = if folder.path().join("deck").is_dir() { "deck/" } else { "deck" };
            let out = Command::new(&program[0])
                .args(&program[1..])
                .arg(name)
                .current_dir(&folder)
                .output()
                .unwrap();
            let said = String::from_utf8_lossy(&out.stdout);
            println!(
                "{case} {integrator} {stepping} {format}: {}",
                said.lines().next().unwrap_or_default()
            );
            let in_part = said.contains("beyond, the motion cannot be predicted");
            assert_eq!(in_part, case == "block.toml", "{case} {stepping} {format}: {said}");
            assert!(
                out.status.success() && said.contains("within 1 %: yes"),
                "{case} {integrator} {stepping} {format}: {said}"
            );
        }
    }
}

/// Decks of elastic structures with substeps at touches end within 1 % of what our emulation found,
/// as far as the motion can be predicted, in Python and in Tcl: a pier without damping, for which
/// OpenSees for Tcl may have no objects.
#[test]
#[ignore = "needs OpenSees, which cargo cannot install; .ci/run installs it and runs this"]
fn elastic_decks_of_substeps_at_touches_find_what_the_emulation_found() {
    let folder = tempfile::tempdir().unwrap();
    let run = |args: &str| {
        let out = tune(folder.path(), &args.split_whitespace().collect::<Vec<_>>());
        assert!(out.status.success(), "{args}: {}", String::from_utf8_lossy(&out.stderr));
    };
    let pier = "[structure]\nkind = 'pier'\nheight_m = 12.0\nwidth_m = 4.0\nmass_kg = 600e3\n\
                footing_mass_kg = 60e3\nfooting_height_m = 1.5\nfrequency_hz = 2.0\n\
                damping_ratio = 0.0\n";
    std::fs::write(folder.path().join("pier.toml"), pier).unwrap();
    run("run pier.toml --quiet --no-figures --no-report --no-front --duration 8 --step 0.001 \
         --integrator trbdf2");
    for format in ["openseespy", "opensees-tcl"] {
        run(&format!(
            "export --parameters out/parameters.json --format {format} --stepping touches \
             --out deck"
        ));
        let Some(program) = interpreter(format) else { continue };
        let out = Command::new(&program[0])
            .args(&program[1..])
            .arg("deck")
            .current_dir(&folder)
            .output()
            .unwrap();
        let said = String::from_utf8_lossy(&out.stdout);
        println!("pier touches {format}: {}", said.lines().next().unwrap_or_default());
        assert!(out.status.success() && said.contains("within 1 %: yes"), "{format}: {said}");
    }
}
