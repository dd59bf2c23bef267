//! What the workspace is built from: licences that ours allows, the public registry, few crates twice.

use serde_json::Value;
use spdx::{Expression, LicenseReq, ParseMode};
use std::collections::BTreeMap;
use std::process::Command;

/// Every package that a build for this machine may take, as cargo tells it.
fn packages() -> Vec<Value> {
    let host = Command::new("rustc").arg("-vV").output().unwrap();
    let host = String::from_utf8(host.stdout).unwrap();
    let host = host.lines().find_map(|l| l.strip_prefix("host: ")).unwrap();
    let said = Command::new(env!("CARGO"))
        .args(["metadata", "--format-version", "1", "--locked", "--filter-platform", host])
        .current_dir(env!("CARGO_MANIFEST_DIR"))
        .output()
        .unwrap();
    assert!(said.status.success(), "{}", String::from_utf8_lossy(&said.stderr));
    let all: Value = serde_json::from_slice(&said.stdout).unwrap();
    let needed = all["resolve"]["nodes"].as_array().unwrap();
    let needed = |id: &Value| needed.iter().any(|n| &n["id"] == id);
    all["packages"].as_array().unwrap().iter().filter(|p| needed(&p["id"])).cloned().collect()
}

/// The rules, shared with `cargo deny check`.
fn rules() -> toml::Table {
    let path = concat!(env!("CARGO_MANIFEST_DIR"), "/../../deny.toml");
    std::fs::read_to_string(path).unwrap().parse().unwrap()
}

#[test]
fn every_licence_is_allowed() {
    let rules = rules();
    let allowed: Vec<&str> =
        rules["licenses"]["allow"].as_array().unwrap().iter().map(|l| l.as_str().unwrap()).collect();
    let packages = packages();
    assert!(packages.len() > 50, "the registry's crates are among them");
    for p in packages {
        let licence = p["license"].as_str().unwrap_or("");
        let expression = Expression::parse_mode(licence, ParseMode::LAX)
            .unwrap_or_else(|e| panic!("{}: licence `{licence}`: {e}", p["name"]));
        let ok = expression.evaluate(|r: &LicenseReq| allowed.contains(&r.to_string().as_str()));
        assert!(ok, "{}: `{licence}` is not among those of deny.toml", p["name"]);
    }
}

#[test]
fn every_crate_is_ours_or_from_the_public_registry() {
    for p in packages() {
        let ours = p["source"].is_null()
            && p["name"].as_str().is_some_and(|n| n == "xtask" || n.starts_with("brazilnut"));
        let registry = p["source"].as_str().is_some_and(|s| s.starts_with("registry+"));
        assert!(ours || registry, "{} comes from {}", p["name"], p["source"]);
    }
}

#[test]
fn no_crate_comes_in_two_versions_unless_listed() {
    let mut versions: BTreeMap<String, usize> = BTreeMap::new();
    for p in packages() {
        *versions.entry(p["name"].as_str().unwrap().into()).or_default() += 1;
    }
    let twice: Vec<&str> = versions.iter().filter(|(_, n)| **n > 1).map(|(name, _)| name.as_str()).collect();
    let rules = rules();
    let listed: Vec<&str> =
        rules["bans"]["skip"].as_array().unwrap().iter().map(|s| s["crate"].as_str().unwrap()).collect();
    assert_eq!(twice, listed);
}
