//! The lock between processes, one of which is killed.

use brazilnut_store::{Cause, Lock};
use std::io::{BufRead, BufReader};
use std::path::Path;
use std::process::{Command, Stdio};

const FOLDER: &str = "BRAZILNUT_TEST_LOCK_FOLDER";

/// Not a test by itself: what the other process of the next test does.
#[test]
fn hold_the_lock_if_told_to() {
    let Some(folder) = std::env::var_os(FOLDER) else { return };
    let _lock = Lock::take(Path::new(&folder)).unwrap();
    // On a line of its own: the test harness has written part of one already.
    println!("\nheld");
    std::thread::sleep(std::time::Duration::from_secs(60));
}

#[test]
fn a_killed_process_leaves_no_lock() {
    let folder = tempfile::tempdir().unwrap();
    let mut child = Command::new(std::env::current_exe().unwrap())
        .args(["--exact", "hold_the_lock_if_told_to", "--nocapture"])
        .env(FOLDER, folder.path())
        .stdout(Stdio::piped())
        .spawn()
        .unwrap();
    let mut lines = BufReader::new(child.stdout.take().unwrap()).lines();
    assert!(lines.any(|l| l.unwrap() == "held"), "the other process has the lock");
    let error = Lock::take(folder.path()).unwrap_err();
    assert!(matches!(error.cause, Cause::Locked(_)), "{error}");
    assert!(error.to_string().contains(&format!("process {}", child.id())), "{error}");
    child.kill().unwrap();
    child.wait().unwrap();
    Lock::take(folder.path()).unwrap();
}
