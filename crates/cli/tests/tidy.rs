//! Rules of the house that the compiler does not know. `cargo xtask tidy` runs this file alone.

use std::collections::{BTreeMap, BTreeSet};
use std::path::{Path, PathBuf};

/// Longest source file, lines (ARCHITECTURE.md).
const LONGEST: usize = 600;

fn root() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../..").canonicalize().unwrap()
}

fn read(path: impl AsRef<Path>) -> String {
    let path = root().join(path);
    std::fs::read_to_string(&path).unwrap_or_else(|e| panic!("{}: {e}", path.display()))
}

/// All Rust files below `folder`, as path from the root and text.
fn sources(folder: &str) -> Vec<(String, String)> {
    fn collect(folder: &Path, out: &mut Vec<PathBuf>) {
        for entry in std::fs::read_dir(folder).unwrap() {
            let path = entry.unwrap().path();
            if path.is_dir() && !path.ends_with("target") {
                collect(&path, out);
            } else if path.extension().is_some_and(|e| e == "rs") {
                out.push(path);
            }
        }
    }
    let mut paths = vec![];
    collect(&root().join(folder), &mut paths);
    paths.sort();
    let shown = |p: &Path| p.strip_prefix(root()).unwrap().display().to_string();
    paths.iter().map(|p| (shown(p), std::fs::read_to_string(p).unwrap())).collect()
}

/// Names of the folders in `folder`.
fn folders(folder: &str) -> BTreeSet<String> {
    std::fs::read_dir(root().join(folder))
        .unwrap()
        .map(|e| e.unwrap())
        .filter(|e| e.path().is_dir())
        .map(|e| e.file_name().to_string_lossy().into_owned())
        .collect()
}

#[test]
fn no_file_is_too_long() {
    let long: Vec<String> = sources("crates")
        .into_iter()
        .chain(sources("xtask"))
        .map(|(path, text)| (path, text.lines().count()))
        .filter(|(_, lines)| *lines > LONGEST)
        .map(|(path, lines)| format!("{path}: {lines} lines"))
        .collect();
    assert!(long.is_empty(), "{long:#?}");
}

#[test]
fn nothing_is_left_undone() {
    for (path, text) in sources("crates") {
        // This file names what it forbids.
        if path.ends_with("tests/tidy.rs") {
            continue;
        }
        for word in ["todo!(", "unimplemented!(", "dbg!("] {
            assert!(!text.contains(word), "{path} holds {word}");
        }
    }
}

#[test]
fn no_state_is_left_out_of_checkpoints() {
    for (path, text) in sources("crates") {
        let skips = ["serde(skip", "skip_serializing", "skip_deserializing"];
        if path.contains("/src/") {
            assert!(!skips.iter().any(|s| text.contains(s)), "{path} leaves a field out of what is saved");
        }
    }
}

#[test]
fn unsafe_code_has_its_reason_beside_it() {
    for (path, text) in sources("crates") {
        for (k, line) in text.lines().enumerate() {
            if line.contains("allow(unsafe_code") {
                let here: String = text.lines().skip(k).take(3).collect();
                assert!(here.contains("reason ="), "{path}:{}", k + 1);
            }
        }
    }
}

/// The crates of ours that `crates/NAME` depends on.
fn uses(name: &str) -> BTreeSet<String> {
    let manifest: toml::Table = read(format!("crates/{name}/Cargo.toml")).parse().unwrap();
    let own = |d: &String| d.strip_prefix("brazilnut-").map(String::from);
    manifest["dependencies"].as_table().unwrap().keys().filter_map(own).collect()
}

#[test]
fn crates_use_each_other_as_the_map_says() {
    let text = read("ARCHITECTURE.md");
    let mut map: BTreeMap<String, BTreeSet<String>> = BTreeMap::new();
    let table = text.split("| crate |").nth(1).expect("a table of crates").split("\n\n").next().unwrap();
    for row in table.lines().skip(2) {
        let cells: Vec<&str> = row.trim_matches('|').split('|').map(str::trim).collect();
        let names = |cell: &str| -> BTreeSet<String> {
            cell.split('`').skip(1).step_by(2).map(String::from).collect()
        };
        let name = names(cells[0]).into_iter().next().unwrap();
        let _ = map.insert(name, names(cells[1]));
    }
    assert_eq!(map.keys().cloned().collect::<BTreeSet<_>>(), folders("crates"), "the crates of the map");
    for (name, wanted) in &map {
        assert_eq!(&uses(name), wanted, "what `{name}` uses");
    }
    // One way only: taking away crates that use nothing left empties the map.
    while !map.is_empty() {
        let free: Vec<String> = map.iter().filter(|(_, u)| u.is_empty()).map(|(n, _)| n.clone()).collect();
        assert!(!free.is_empty(), "a circle among {:?}", map.keys());
        for name in free {
            let _ = map.remove(&name);
            map.values_mut().for_each(|u| {
                let _ = u.remove(&name);
            });
        }
    }
}

#[test]
fn paths_named_in_the_documents_exist() {
    for document in ["README.md", "ARCHITECTURE.md", "CONTRIBUTING.md"] {
        for path in read(document).split('`').skip(1).step_by(2) {
            let top = path.split('/').next().unwrap();
            let ours = ["crates", "studies", "cases", "docs", "benches", "scripts", "xtask", ".ci"];
            let plain = !path.contains([' ', '<', '*', '{']) && path.chars().all(|c| !c.is_uppercase());
            if path.contains('/') && ours.contains(&top) && plain {
                assert!(root().join(path).exists(), "{document} names {path}, which does not exist");
            }
        }
    }
}

#[test]
fn every_study_has_its_folder_and_its_line() {
    let menu = read("crates/studies/src/menu.rs");
    let folders = folders("studies");
    assert!(!folders.is_empty());
    for study in &folders {
        for file in ["README.md", "published.toml"] {
            let text = read(format!("studies/{study}/{file}"));
            assert!(!text.trim().is_empty(), "studies/{study}/{file} is empty");
        }
        let published: toml::Table = read(format!("studies/{study}/published.toml")).parse().unwrap();
        assert!(!published.is_empty());
        assert!(menu.contains(&format!("\"{study}\"")), "{study} has no line in the menu");
    }
    assert_eq!(menu.matches("study!(").count(), folders.len(), "as many lines as folders");
}

#[test]
fn no_code_writes_published_numbers() {
    for (path, text) in sources("crates/studies") {
        let writes = text.lines().any(|l| l.contains("published.toml") && l.contains("write"));
        assert!(!writes, "{path} writes published.toml");
    }
}
