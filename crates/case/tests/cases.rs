//! Case files beside what is said of them: bad ones with their messages, good ones that read back.

use brazilnut_base::keys::{Key, Kind};
use brazilnut_case::{Case, Issues, analytic, build, check, keys, resolved, schema};
use std::path::{Path, PathBuf};

/// Everything that can be wrong with a case, from its text to the assembled parts.
fn read(text: &str, name: &str, folder: &Path) -> Result<Case, Issues> {
    let case = Case::parse(text, name, folder.to_path_buf(), &[])?;
    if check::is_analytical(case.model()) {
        analytic::solve(&case, case.model()).map(|_| ())?;
    } else {
        build::build(&case).map(|_| ())?;
    }
    Ok(case)
}

/// Name and text of every case in `tests/FOLDER`, in the order of their names.
fn files(folder: &str) -> Vec<(String, String)> {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests").join(folder);
    let mut paths: Vec<PathBuf> = std::fs::read_dir(folder).unwrap().map(|e| e.unwrap().path()).collect();
    paths.retain(|p| p.extension().is_some_and(|e| e == "toml"));
    paths.sort();
    let name = |p: &Path| p.file_name().unwrap().to_string_lossy().into_owned();
    paths.iter().map(|p| (name(p), std::fs::read_to_string(p).unwrap())).collect()
}

#[test]
fn every_bad_case_is_refused_with_its_message() {
    let cases = files("bad");
    assert!(cases.len() >= 25);
    let mut wrong = String::new();
    for (name, text) in &cases {
        let wanted: Vec<&str> = text.lines().filter_map(|l| l.strip_prefix("#! ")).collect();
        assert!(!wanted.is_empty(), "{name} expects nothing");
        let shown = match read(text, name, Path::new("")) {
            Ok(_) => "(accepted)".to_string(),
            Err(issues) => {
                assert!(!issues.is_empty(), "{name} is refused without a word");
                issues.render(false)
            }
        };
        // The caret shows lines of the source, where the expectations stand too.
        let shown: String =
            shown.lines().filter(|l| !l.contains("#! ")).collect::<Vec<_>>().join("\n") + "\n";
        for w in wanted.iter().filter(|w| !shown.contains(**w)) {
            wrong += &format!("{name} does not say: {w}\n{shown}\n");
        }
    }
    assert!(wrong.is_empty(), "{wrong}");
}

#[test]
fn a_message_has_line_caret_cause_and_remedy() {
    let (_, text) = files("bad").into_iter().find(|(n, _)| n == "unknown-material.toml").unwrap();
    let shown = read(&text, "x.toml", Path::new("")).unwrap_err().render(false);
    let line = 1 + text.lines().position(|l| l.starts_with("material = ")).unwrap();
    assert!(shown.contains(&format!("x.toml:{line}:12")), "{shown}");
    assert!(shown.contains("^^^^^^^^ not under `materials`"), "{shown}");
    assert!(shown.contains("help: did you mean `bronze`?"), "{shown}");
}

#[test]
fn a_resolved_case_reads_back_to_the_same_values() {
    for (name, text) in files("good") {
        let case = read(&text, &name, Path::new("")).unwrap_or_else(|e| panic!("{name}:\n{e}"));
        let copy = case.resolved();
        let again = read(&copy, &name, Path::new("")).unwrap_or_else(|e| panic!("{name}:\n{e}\n{copy}"));
        assert_eq!(resolved::flatten(&case.values), resolved::flatten(&again.values), "{name}");
        assert_eq!(copy, again.resolved(), "{name}: the copy of the copy");
    }
}

#[test]
fn overrides_replace_what_the_file_says() {
    let (_, text) = files("good").into_iter().find(|(n, _)| n == "dry.toml").unwrap();
    let set = |o: &[&str]| {
        let overrides: Vec<String> = o.iter().map(ToString::to_string).collect();
        Case::parse(&text, "x.toml", PathBuf::new(), &overrides)
    };
    let case = set(&["shaking.gamma=2.5", "grains.bronze.count=7", "grains.0.diameter=1.5 mm"]).unwrap();
    let flat = resolved::flatten(&case.values);
    assert_eq!(flat["shaking.gamma"], "2.5");
    assert_eq!(flat["grains[0].count"], "7");
    assert_eq!(flat["grains[0].diameter.mean"], "0.0015");
    let shown = set(&["shaking.gama=2.5"]).unwrap_err().render(false);
    assert!(shown.contains("did you mean `gamma`?") && shown.contains("shaking.gama = 2.5"), "{shown}");
    assert!(set(&["grains.stone.count=7"]).unwrap_err().render(false).contains("has no entry `stone`"));
}

/// Every name of a key in `keys`, down to the last table and variant.
fn names(keys: &[Key], out: &mut Vec<&'static str>) {
    for key in keys {
        out.push(key.name);
        match key.kind {
            Kind::Table { keys, .. } | Kind::Tables(keys) | Kind::NamedTables(keys) => names(keys, out),
            Kind::Variants { common, menu, keys, .. } => {
                names(common, out);
                menu().iter().for_each(|e| names(keys(e.name), out));
            }
            _ => {}
        }
    }
}

#[test]
fn the_schema_names_every_key() {
    let text = schema::schema().to_string();
    let back: serde_json::Value = serde_json::from_str(&text).unwrap();
    assert_eq!(back["type"], "object");
    let mut all = vec![];
    names(&keys::root(), &mut all);
    assert!(all.len() > 100);
    for name in all {
        assert!(text.contains(&format!("\"{name}\":")), "the schema does not name `{name}`");
    }
}

#[test]
fn every_key_is_described() {
    for key in keys::root() {
        let page = brazilnut_case::describe::describe(Some(key.name)).unwrap();
        assert!(page.contains(key.doc), "{}", key.name);
    }
    let error = brazilnut_case::describe::describe(Some("shakin")).unwrap_err();
    assert!(error.contains("did you mean `shaking`?"), "{error}");
}
