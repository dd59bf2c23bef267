//! The command as a person or a script meets it: exit codes, files, and the same bytes whatever happens.

use std::collections::BTreeMap;
use std::path::{Path, PathBuf};
use std::process::{Command, Output};
use std::sync::OnceLock;
use tempfile::TempDir;

const CASE: &str = include_str!("data/tiny.toml");

/// Runs the command with `arguments` in `folder`.
fn brazilnut(folder: &Path, arguments: &[&str]) -> Output {
    Command::new(env!("CARGO_BIN_EXE_brazilnut")).args(arguments).current_dir(folder).output().unwrap()
}

/// Exit code and what was said on standard error.
fn code(folder: &Path, arguments: &[&str]) -> (i32, String) {
    let out = brazilnut(folder, arguments);
    (out.status.code().unwrap_or(-1), String::from_utf8_lossy(&out.stderr).into_owned())
}

/// As [`code`], but must end well.
fn ok(folder: &Path, arguments: &[&str]) {
    let (code, said) = code(folder, arguments);
    assert_eq!(code, 0, "{arguments:?}: {said}");
}

/// A folder with the tiny case in it; in memory where it can be, for runs sync what they write.
fn folder() -> TempDir {
    let memory = Path::new("/dev/shm");
    let folder = if memory.is_dir() { tempfile::tempdir_in(memory) } else { tempfile::tempdir() }.unwrap();
    std::fs::write(folder.path().join("tiny.toml"), CASE).unwrap();
    folder
}

/// The bytes of what a run gives: tables, frames, pictures, lists and the newest checkpoint.
/// Status and report hold wall-clock times, the lock a process number.
fn results(run: &Path) -> BTreeMap<PathBuf, Vec<u8>> {
    fn collect(root: &Path, folder: &Path, out: &mut BTreeMap<PathBuf, Vec<u8>>) {
        for entry in std::fs::read_dir(folder).unwrap() {
            let path = entry.unwrap().path();
            if path.is_dir() {
                collect(root, &path, out);
            } else {
                let bytes = std::fs::read(&path).unwrap();
                let _ = out.insert(path.strip_prefix(root).unwrap().to_path_buf(), bytes);
            }
        }
    }
    let mut all = BTreeMap::new();
    collect(run, run, &mut all);
    let newest = all.keys().filter(|p| p.starts_with("checkpoints")).max().cloned();
    all.retain(|p, _| {
        !matches!(p.to_str(), Some("run.json" | "report.html" | ".lock"))
            && (!p.starts_with("checkpoints") || newest.as_ref() == Some(p))
    });
    all
}

/// Every file of two runs is the same, byte for byte.
fn assert_same(a: &BTreeMap<PathBuf, Vec<u8>>, b: &BTreeMap<PathBuf, Vec<u8>>, what: &str) {
    assert_eq!(a.keys().collect::<Vec<_>>(), b.keys().collect::<Vec<_>>(), "{what}: the files");
    for (path, bytes) in a {
        assert!(bytes == &b[path], "{what}: {} differs", path.display());
    }
}

/// What the tiny case gives when nothing interrupts it, on two threads.
fn unbroken() -> &'static BTreeMap<PathBuf, Vec<u8>> {
    static RUN: OnceLock<BTreeMap<PathBuf, Vec<u8>>> = OnceLock::new();
    RUN.get_or_init(|| {
        let folder = folder();
        ok(folder.path(), &["run", "tiny.toml", "--out", "run", "--quiet", "--threads", "2"]);
        results(&folder.path().join("run"))
    })
}

fn status(run: &Path) -> serde_json::Value {
    serde_json::from_str(&std::fs::read_to_string(run.join("run.json")).unwrap()).unwrap()
}

#[test]
fn a_run_leaves_tables_frames_pictures_and_a_report() {
    let all = unbroken();
    for path in ["case.toml", "grains.pvd", "tables/bed.csv", "tables/energy.csv", "tables/collisions.csv"] {
        assert!(all.contains_key(Path::new(path)), "{path} is missing");
    }
    let count = |folder: &str| all.keys().filter(|p| p.starts_with(folder)).count();
    assert_eq!(count("grains"), 5, "two frames a cycle, both ends of two cycles");
    assert_eq!(count("checkpoints"), 1);
    assert!(count("pictures") >= 2);
    let table = String::from_utf8(all[Path::new("tables/bed.csv")].clone()).unwrap();
    let rows = table.lines().filter(|l| l.starts_with(|c: char| c.is_ascii_digit())).count();
    assert_eq!(rows, 25, "twelve rows a cycle, both ends of two cycles");
}

#[test]
fn the_same_bytes_for_any_number_of_threads() {
    for threads in ["1", "3"] {
        let folder = folder();
        ok(folder.path(), &["run", "tiny.toml", "--out", "run", "--quiet", "--threads", threads]);
        assert_same(unbroken(), &results(&folder.path().join("run")), &format!("{threads} threads"));
    }
}

/// Stops a run with `stop`, resumes it, and compares with the unbroken one.
fn stop_and_resume(stop: &[&str], first: &str, second: &str) {
    let folder = folder();
    let mut run = vec!["run", "tiny.toml", "--out", "run", "--quiet", "--threads", first];
    run.extend(stop);
    let (code, said) = code(folder.path(), &run);
    assert_eq!(code, 4, "{stop:?}: {said}");
    assert_eq!(status(&folder.path().join("run"))["status"], "stopped");
    ok(folder.path(), &["resume", "run", "--quiet", "--threads", second]);
    assert_eq!(status(&folder.path().join("run"))["status"], "done");
    assert_same(unbroken(), &results(&folder.path().join("run")), &format!("{stop:?} {first} {second}"));
}

#[test]
fn a_run_stopped_while_settling_goes_on_as_if_nothing_had_happened() {
    stop_and_resume(&["--wall-limit", "0s"], "1", "3");
}

#[test]
fn a_run_stopped_at_the_start_of_the_shaking_goes_on_as_if_nothing_had_happened() {
    stop_and_resume(&["--stop-after", "1"], "2", "1");
}

#[test]
fn a_run_stopped_between_samples_goes_on_as_if_nothing_had_happened() {
    // 1703 is prime: no observer, frame or rebuild of a list falls on it by design.
    stop_and_resume(&["--stop-after", "1703"], "3", "2");
}

#[test]
fn a_run_stopped_again_and_again_goes_on_as_if_nothing_had_happened() {
    let folder = folder();
    let stop = |n: &'static str| ["--quiet", "--stop-after", n];
    let begin = [&["run", "tiny.toml", "--out", "run"][..], &stop("500")].concat();
    assert_eq!(code(folder.path(), &begin).0, 4);
    for n in ["501", "2280", "4559"] {
        let (code, said) = code(folder.path(), &[&["resume", "run"][..], &stop(n)].concat());
        assert_eq!(code, 4, "{said}");
    }
    ok(folder.path(), &["resume", "run", "--quiet"]);
    assert_same(unbroken(), &results(&folder.path().join("run")), "four stops");
    // A run that is over stays as it is.
    ok(folder.path(), &["resume", "run", "--quiet"]);
    assert_same(unbroken(), &results(&folder.path().join("run")), "resumed after its end");
}

#[test]
fn a_run_can_go_on_beyond_its_end_as_if_that_had_been_asked_from_the_start() {
    let folder = folder();
    let out = |name: &'static str| ["run", "tiny.toml", "--quiet", "--out", name];
    ok(folder.path(), &[&out("long")[..], &["--set", "time.end=3 cycles"]].concat());
    ok(folder.path(), &out("short"));
    ok(folder.path(), &["resume", "short", "--quiet", "--until", "3 cycles"]);
    // Pictures are spread over the whole run, so their moments follow its end.
    let of = |name: &str| {
        let mut all = results(&folder.path().join(name));
        all.retain(|p, _| !p.starts_with("pictures"));
        all
    };
    assert_same(&of("long"), &of("short"), "one cycle more");
    // The new end is the case's from now on; going back is refused, and so is nonsense.
    ok(folder.path(), &["resume", "short", "--quiet"]);
    for (end, word) in [("1 cycles", "beyond the end"), ("3 mm", "time.end"), ("soon", "time.end")] {
        let (refused, said) = code(folder.path(), &["resume", "short", "--quiet", "--until", end]);
        assert_eq!(refused, 2, "{end}: {said}");
        assert!(said.contains(word), "{end}: {said}");
        assert_same(&of("long"), &of("short"), end);
    }
}

#[test]
fn every_model_with_a_flow_resumes_to_the_same_bytes_on_any_number_of_threads() {
    const MODELS: [&str; 5] =
        ["fluid", "navier-stokes", "particle-template", "fluid-springs", "direct-forcing"];
    for model in MODELS {
        let folder = folder();
        let model = format!("model={model}");
        let run = |out: &'static str, threads: &'static str| {
            let mut words = vec!["run", "tiny.toml", "--quiet", "--out", out, "--threads", threads];
            let cell = "cell.size=[\"3 mm\", \"3 mm\", \"4 mm\"]";
            let few = ["grains.bronze.count=6", cell, "time.settle=1 ms", "output.pictures=0"];
            let rest = ["time.end=6 ms", "output.frames=1 ms", "fluid-springs.c_s=0.6", "fluid.spacing=2e-4"];
            for set in few.into_iter().chain(rest).chain([model.as_str()]) {
                words.extend(["--set", set]);
            }
            words.into_iter().map(String::from).collect::<Vec<_>>()
        };
        let go = |words: &[String]| {
            let words: Vec<&str> = words.iter().map(String::as_str).collect();
            code(folder.path(), &words)
        };
        let (ended, said) = go(&run("unbroken", "2"));
        assert_eq!(ended, 0, "{model}: {said}");
        let wanted = results(&folder.path().join("unbroken"));
        assert!(wanted.keys().any(|p| p.starts_with("checkpoints")), "{model}");
        for (first, second) in [("1", "3"), ("3", "1")] {
            let mut words = run("broken", first);
            words.extend(["--force", "--stop-after", "17"].map(String::from));
            let (stopped, said) = go(&words);
            assert_eq!(stopped, 4, "{model}: {said}");
            ok(folder.path(), &["resume", "broken", "--quiet", "--threads", second]);
            let got = results(&folder.path().join("broken"));
            assert_same(&wanted, &got, &format!("{model} on {first}, then {second} threads"));
        }
    }
}

#[test]
fn observers_do_not_touch_what_they_observe() {
    let folder = folder();
    let bare = CASE.split("[[observe]]").next().unwrap();
    std::fs::write(folder.path().join("bare.toml"), bare).unwrap();
    ok(folder.path(), &["run", "bare.toml", "--out", "run", "--quiet"]);
    let observed = unbroken();
    let all = results(&folder.path().join("run"));
    let frames: Vec<_> = all.keys().filter(|p| p.starts_with("grains")).collect();
    assert_eq!(frames.len(), 5);
    for path in frames {
        assert!(all[path] == observed[path], "{} differs", path.display());
    }
}

#[test]
fn an_edited_case_is_refused_with_what_differs() {
    let folder = folder();
    let run = ["run", "tiny.toml", "--out", "run", "--quiet", "--stop-after", "700"];
    assert_eq!(code(folder.path(), &run).0, 4);
    let case = folder.path().join("run/case.toml");
    let text = std::fs::read_to_string(&case).unwrap();
    let edit = |from: &str, to: &str| {
        assert!(text.contains(from), "{from} in\n{text}");
        std::fs::write(&case, text.replace(from, to)).unwrap();
    };
    edit("gamma = 3.0", "gamma = 2.5");
    let (refused, said) = code(folder.path(), &["resume", "run", "--quiet"]);
    assert_eq!(refused, 2, "{said}");
    assert!(said.contains("shaking.gamma: 3.0 then, 2.5 now"), "{said}");
    assert!(!said.contains("contact."), "only what differs is listed: {said}");
    // The title is no physics.
    edit("title = \"Sixty beads\"", "title = \"Another title\"");
    ok(folder.path(), &["resume", "run", "--quiet"]);
    let mut all = results(&folder.path().join("run"));
    let mut wanted = unbroken().clone();
    for runs in [&mut all, &mut wanted] {
        runs.retain(|p, _| p.starts_with("tables") || p.starts_with("grains"));
    }
    assert_same(&wanted, &all, "another title");
}

#[test]
fn a_damaged_checkpoint_gives_way_to_the_one_before_it() {
    let folder = folder();
    let run = ["run", "tiny.toml", "--out", "run", "--quiet", "--stop-after", "700"];
    assert_eq!(code(folder.path(), &run).0, 4);
    assert_eq!(code(folder.path(), &["resume", "run", "--quiet", "--stop-after", "1500"]).0, 4);
    let checkpoints = folder.path().join("run/checkpoints");
    let mut list: Vec<PathBuf> =
        std::fs::read_dir(&checkpoints).unwrap().map(|e| e.unwrap().path()).collect();
    list.sort();
    assert_eq!(list.len(), 2);
    let newest = list.last().unwrap();
    let bytes = std::fs::read(newest).unwrap();
    std::fs::write(newest, &bytes[..bytes.len() / 2]).unwrap();
    ok(folder.path(), &["resume", "run", "--quiet"]);
    assert_same(unbroken(), &results(&folder.path().join("run")), "from the older checkpoint");
    let warnings = status(&folder.path().join("run"))["warnings"].to_string();
    assert!(warnings.contains("was not used"), "{warnings}");
    // With none left there is nothing to continue.
    for entry in std::fs::read_dir(&checkpoints).unwrap() {
        std::fs::write(entry.unwrap().path(), b"not a checkpoint").unwrap();
    }
    let (code, said) = code(folder.path(), &["resume", "run", "--quiet"]);
    assert_ne!(code, 0);
    assert!(said.contains("none of its checkpoints is whole"), "{said}");
}

#[test]
fn a_blow_up_names_its_place_and_exits_with_3() {
    let folder = folder();
    let run = ["run", "tiny.toml", "--out", "run", "--quiet", "--set", "limits.overlap=1e-5"];
    let (code, said) = code(folder.path(), &run);
    assert_eq!(code, 3, "{said}");
    for part in ["blew up", "in step", "overlap", "grain ", " at (", "remedy:"] {
        assert!(said.contains(part), "{part}: {said}");
    }
    let status = status(&folder.path().join("run"));
    assert_eq!(status["status"], "blown-up");
    assert!(status["error"].as_str().unwrap().contains("overlap"));
    assert!(folder.path().join("run/report.html").exists());
}

#[test]
fn a_guard_that_only_warns_lets_the_run_go_on() {
    let folder = folder();
    let set = ["--set", "limits.overlap=1e-5", "--set", "limits.action=warn", "--set", "time.end=5 ms"];
    ok(folder.path(), &[&["run", "tiny.toml", "--out", "run", "--quiet"][..], &set].concat());
    let warnings = status(&folder.path().join("run"))["warnings"].to_string();
    assert!(warnings.contains("overlap"), "{warnings}");
}

#[test]
fn wrong_input_exits_with_2_and_leaves_nothing() {
    let folder = folder();
    let mut bad: Vec<Vec<&str>> = vec![
        vec!["run", "nowhere.toml"],
        vec!["check", "nowhere.toml"],
        vec!["resume", "nowhere"],
        vec!["new", "x", "--from", "no-such-case"],
        vec!["describe", "contakt"],
        vec!["run", "tiny.toml", "--threads", "0"],
        vec!["run", "tiny.toml", "--wall-limit", "soon"],
        vec!["frobnicate"],
    ];
    let sets = [
        "grains.bronze.diameter=-1 mm",
        "shaking.frequency=40 mm",
        "shaking.peak_velocity=1",
        "grains.bronze.count=5000",
        "grains.bronze.count=0",
        "time.dt=1 s",
        "time.and=1 s",
        "model=navier-strokes",
        "contact.friction=",
        "observe.0.every=7 per cycle",
    ];
    for set in sets {
        bad.push(vec!["run", "tiny.toml", "--set", set]);
        bad.push(vec!["check", "tiny.toml", "--set", set]);
    }
    for arguments in bad {
        let (code, said) = code(folder.path(), &arguments);
        assert_eq!(code, 2, "{arguments:?}: {said}");
        assert!(said.contains("error"), "{arguments:?}: {said}");
        assert!(!said.contains("panicked"), "{arguments:?}: {said}");
        let left: Vec<_> =
            std::fs::read_dir(folder.path()).unwrap().map(|e| e.unwrap().file_name()).collect();
        assert_eq!(left, ["tiny.toml"], "{arguments:?} left something behind");
    }
}

#[test]
fn an_output_folder_that_cannot_be_made_is_wrong_input() {
    let folder = folder();
    std::fs::write(folder.path().join("file"), "").unwrap();
    let (code, said) = code(folder.path(), &["run", "tiny.toml", "--out", "file/run"]);
    assert_eq!(code, 2, "{said}");
    assert!(said.contains("file/run"), "{said}");
}

#[test]
fn a_run_is_not_replaced_unasked() {
    let folder = folder();
    let run = ["run", "tiny.toml", "--out", "run", "--quiet", "--set", "time.end=1 ms"];
    ok(folder.path(), &run);
    std::fs::write(folder.path().join("run/notes.txt"), "mine").unwrap();
    let before = results(&folder.path().join("run"));
    let (refused, said) = code(folder.path(), &run);
    assert_eq!(refused, 2);
    assert!(said.contains("--force") && said.contains("brazilnut resume run"), "{said}");
    assert_same(&before, &results(&folder.path().join("run")), "refused");
    ok(folder.path(), &[&run[..], &["--force"]].concat());
    assert_same(&before, &results(&folder.path().join("run")), "replaced by the same, notes kept");
}

#[test]
fn two_runs_cannot_write_one_directory() {
    let folder = folder();
    let run = ["run", "tiny.toml", "--out", "run", "--quiet", "--set", "time.end=1 ms"];
    ok(folder.path(), &run);
    let before = results(&folder.path().join("run"));
    let lock = std::fs::OpenOptions::new().write(true).open(folder.path().join("run/.lock")).unwrap();
    lock.lock().unwrap();
    for arguments in [&[&run[..], &["--force"]].concat()[..], &["resume", "run", "--quiet"]] {
        let (code, said) = code(folder.path(), arguments);
        assert_ne!(code, 0, "{arguments:?}");
        assert!(said.contains("is writing it"), "{arguments:?}: {said}");
        assert_same(&before, &results(&folder.path().join("run")), "under a lock");
    }
    drop(lock);
    ok(folder.path(), &[&run[..], &["--force"]].concat());
}

#[test]
fn what_was_asked_on_the_command_line_stands_in_the_resolved_case() {
    let folder = folder();
    let set = ["--set", "shaking.gamma=2.5", "--set", "grains.bronze.count=12", "--seed", "7"];
    let end = ["--set", "time.end=1 ms"];
    ok(folder.path(), &[&["run", "tiny.toml", "--out", "run", "--quiet"][..], &set, &end].concat());
    let text = std::fs::read_to_string(folder.path().join("run/case.toml")).unwrap();
    for line in ["gamma = 2.5", "count = 12", "seed = 7", "end = \"0.001 s\""] {
        assert!(text.contains(line), "{line} in\n{text}");
    }
}

#[cfg(unix)]
#[test]
fn a_signal_stops_a_run_with_a_good_checkpoint() {
    let folder = folder();
    let mut child = Command::new(env!("CARGO_BIN_EXE_brazilnut"))
        .args(["run", "tiny.toml", "--out", "run", "--quiet", "--set", "time.end=1000 cycles"])
        .current_dir(folder.path())
        .spawn()
        .unwrap();
    // The status is written once the signals are caught.
    let begun = std::time::Instant::now();
    while !folder.path().join("run/run.json").exists() && begun.elapsed().as_secs() < 60 {
        std::thread::sleep(std::time::Duration::from_millis(10));
    }
    assert!(Command::new("kill").args(["-TERM", &child.id().to_string()]).status().unwrap().success());
    assert_eq!(child.wait().unwrap().code(), Some(130));
    assert_eq!(status(&folder.path().join("run"))["status"], "interrupted");
    assert_eq!(code(folder.path(), &["resume", "run", "--quiet", "--wall-limit", "0s"]).0, 4);
}

#[test]
fn the_other_commands_answer() {
    let folder = folder();
    let said = |arguments: &[&str]| {
        let out = brazilnut(folder.path(), arguments);
        assert!(out.status.success(), "{arguments:?}");
        String::from_utf8(out.stdout).unwrap()
    };
    assert!(said(&["--help"]).contains("Exit codes"));
    assert!(said(&["describe"]).contains("contact"));
    assert!(said(&["describe", "contact"]).contains("restitution"));
    assert!(said(&["study", "list"]).contains("clement-"));
    assert!(said(&["completions", "bash"]).contains("brazilnut"));
    let schema: serde_json::Value = serde_json::from_str(&said(&["schema"])).unwrap();
    assert_eq!(schema["type"], "object");
    let sheet = said(&["check", "tiny.toml"]);
    for line in ["grains", "Gamma", "contact time", "steps per contact", "shake strength", "memory"] {
        assert!(sheet.contains(line), "{line} in\n{sheet}");
    }
    let _ = said(&["new", "mine"]);
    assert!(said(&["check", "mine.toml"]).contains("Gamma"));
    assert_eq!(code(folder.path(), &["new", "mine"]).0, 2, "a file is not overwritten");
}

#[test]
fn the_bundled_cases_are_sound() {
    let cases = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../cases");
    let mut count = 0;
    for entry in std::fs::read_dir(cases).unwrap() {
        let path = entry.unwrap().path();
        if path.extension().is_some_and(|e| e == "toml") {
            let folder = folder();
            ok(folder.path(), &["check", path.to_str().unwrap()]);
            count += 1;
        }
    }
    assert!(count > 0);
}
