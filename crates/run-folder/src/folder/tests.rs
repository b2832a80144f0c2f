use super::*;

const FILES: &[&str] = &["a.csv", "b.csv", "decks/c.py"];

fn begun(folder: &Path) -> Folder<'_> {
    Folder::begin(folder, "run", FILES, identity(&[&1])).unwrap()
}

/// A run that writes its name and a text into each file.
fn write(results: &Folder, names: &[&str], text: &str) {
    for name in names {
        let path = results.path().join(name);
        fs::create_dir_all(path.parent().unwrap()).unwrap();
        fs::write(path, format!("{name} {text}")).unwrap();
    }
}

fn run(folder: &Path, names: &[&str], text: &str) {
    let results = begun(folder);
    write(&results, names, text);
    results.finish().unwrap();
}

fn left(folder: &Path) -> Vec<&'static str> {
    FILES.iter().copied().filter(|name| folder.join(name).exists()).collect()
}

#[test]
fn what_is_not_written_again_goes_and_its_empty_folder_with_it() {
    let dir = tempfile::tempdir().unwrap();
    run(dir.path(), FILES, "");
    assert_eq!(left(dir.path()), FILES);
    run(dir.path(), &["a.csv"], "");
    assert_eq!(left(dir.path()), ["a.csv"]);
    assert!(!dir.path().join("decks").exists());
}

#[test]
fn what_the_user_made_or_changed_stays() {
    let dir = tempfile::tempdir().unwrap();
    fs::write(dir.path().join("a.csv"), "the user's").unwrap();
    run(dir.path(), &["b.csv", "decks/c.py"], "");
    fs::write(dir.path().join("decks/notes.txt"), "the user's").unwrap();
    fs::write(dir.path().join("b.csv"), "changed").unwrap();
    run(dir.path(), &[], "");
    assert_eq!(left(dir.path()), ["a.csv", "b.csv"]);
    assert!(dir.path().join("decks/notes.txt").exists());
}

#[test]
fn a_list_that_was_tampered_with_names_no_file_of_others() {
    let dir = tempfile::tempdir().unwrap();
    let own = dir.path().join("own.txt");
    fs::write(&own, "x").unwrap();
    let list = format!("{{\"run\": {{\"own.txt\": \"{}\"}}}}", fingerprint(&own).unwrap());
    fs::write(dir.path().join(WRITTEN), list).unwrap();
    run(dir.path(), &["a.csv"], "");
    assert!(own.exists());
}

#[test]
fn the_list_of_an_earlier_version_is_known() {
    let dir = tempfile::tempdir().unwrap();
    fs::write(dir.path().join("b.csv"), "old").unwrap();
    let list = format!(
        "{{\"run\": {{\"b.csv\": \"{}\"}}}}",
        fingerprint(&dir.path().join("b.csv")).unwrap()
    );
    fs::write(dir.path().join(WRITTEN), list).unwrap();
    run(dir.path(), &["a.csv"], "");
    assert_eq!(left(dir.path()), ["a.csv"]);
}

/// A command that fails drops its folder; one that is killed leaves it without a lock.
#[test]
fn a_run_that_does_not_finish_changes_nothing() {
    let dir = tempfile::tempdir().unwrap();
    run(dir.path(), FILES, "old");
    let results = begun(dir.path());
    write(&results, FILES, "new");
    drop(results);
    assert_eq!(fs::read_to_string(dir.path().join("a.csv")).unwrap(), "a.csv old");
    assert!(of_one_run(&dir.path().join("a.csv")).is_ok());

    let Folder { own, _lock, .. } = begun(dir.path());
    let killed = own.keep();
    let living = begun(dir.path());
    assert!(killed.exists() && living.path().exists());
    drop(_lock);
    run(dir.path(), FILES, "new");
    assert!(!killed.exists() && living.path().exists());
}

#[test]
fn while_files_are_exchanged_and_when_one_is_of_another_run_they_are_refused() {
    let (dir, other) = (tempfile::tempdir().unwrap(), tempfile::tempdir().unwrap());
    let file = dir.path().join("a.csv");
    run(dir.path(), FILES, "old");
    run(other.path(), FILES, "new");
    fs::write(dir.path().join(mark("run")), "").unwrap();
    assert!(matches!(of_one_run(&file), Err(FolderError::Mixed { .. })));
    run(dir.path(), FILES, "old");
    assert!(of_one_run(&file).is_ok());
    fs::copy(other.path().join("a.csv"), &file).unwrap();
    assert!(matches!(of_one_run(&file), Err(FolderError::OfAnotherRun { .. })));
    fs::copy(&file, other.path().join("alone.csv")).unwrap();
    assert!(of_one_run(&other.path().join("alone.csv")).is_ok());
}

#[test]
fn files_whose_times_lie_in_the_future_are_exchanged_like_others() {
    let dir = tempfile::tempdir().unwrap();
    run(dir.path(), FILES, "old");
    let later = std::time::SystemTime::now() + std::time::Duration::from_secs(86_400 * 365);
    for name in FILES {
        File::options()
            .append(true)
            .open(dir.path().join(name))
            .unwrap()
            .set_modified(later)
            .unwrap();
    }
    run(dir.path(), FILES, "new");
    assert_eq!(left(dir.path()), FILES);
    assert_eq!(fs::read_to_string(dir.path().join("b.csv")).unwrap(), "b.csv new");
}
