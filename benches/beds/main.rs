//! Speed of whole steps of the grain engine on the beds that its peers were measured on. The claims are
//! ratios: to this engine's own plain sweep, and to a peer, all run in turn. See `benches/README.md`.

mod case;

use brazilnut_base::{Tick, vec3};
use brazilnut_benches::{Clock, Lap, median};
use brazilnut_grains::{Dem, DemState, Gravity, Sweep};
use case::Case;
use clap::Parser;
use std::error::Error;
use std::path::{Path, PathBuf};
use std::process::Command;

const FIELD: Gravity = Gravity(vec3(0.0, 0.0, -9.81));

/// Speed of whole steps of the grain engine, as ratios.
#[derive(Parser)]
struct Args {
    /// Folder with the start states A.txt.gz and bed20k.txt.gz.
    start: PathBuf,
    /// Which beds.
    #[arg(long, default_value = "ABCD")]
    cases: String,
    /// Numbers of threads.
    #[arg(long, value_delimiter = ',', default_value = "1,2")]
    threads: Vec<usize>,
    /// Rounds; the median of their ratios counts.
    #[arg(long, default_value_t = 3)]
    rounds: usize,
    /// The sweeps to run: plain, fast.
    #[arg(long, value_delimiter = ',', default_value = "plain,fast")]
    sweeps: Vec<String>,
    /// Command that runs a peer: START CASE THREADS WARM STEPS are added, and its last line is its rate in
    /// million particle-steps per second.
    #[arg(long)]
    peer: Option<String>,
    /// Given by cargo.
    #[arg(long, hide = true)]
    bench: bool,
}

/// Rates of one contestant, one per round, 1e6 particle-steps/s.
struct Rates {
    name: String,
    rates: Vec<f64>,
}

fn main() -> Result<(), Box<dyn Error>> {
    let args = Args::parse();
    println!(
        "million particle-steps per second, medians of {} rounds; ratios are medians of rounds",
        args.rounds
    );
    for name in args.cases.chars() {
        let case = Case::read(name, &args.start)?;
        for &threads in args.threads.iter().filter(|&&t| name != 'A' || t == 1) {
            let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build()?;
            if name == 'I' {
                pool.install(|| intruder(&args, &case, threads))?;
            } else {
                pool.install(|| bench(&args, &case, threads))?;
            }
        }
    }
    Ok(())
}

/// All contestants in turn, so that a busy machine slows all of them.
fn bench(args: &Args, case: &Case, threads: usize) -> Result<(), String> {
    let mut all: Vec<Rates> = args
        .sweeps
        .iter()
        .cloned()
        .chain(args.peer.iter().map(|_| "peer".into()))
        .map(|name| Rates { name, rates: vec![] })
        .collect();
    let mut notes = String::new();
    for _ in 0..args.rounds {
        for one in &mut all {
            let rate = match (one.name.as_str(), &args.peer) {
                ("peer", Some(command)) => peer(command, &args.start, case, threads)?,
                (sweep, _) => {
                    let (lap, state) = ours(case, sweep)?;
                    notes = format!(
                        "{:.2} processors, {:.2} contacts per grain",
                        lap.processors(),
                        state.contact_count() as f64 / state.len() as f64
                    );
                    (case.steps as f64) * state.len() as f64 / lap.seconds(threads) / 1e6
                }
            };
            one.rates.push(rate);
        }
    }
    print!("{} {threads} thread(s):", case.name);
    for one in &all {
        print!("  {} {:.1}", one.name, median(one.rates.clone()));
    }
    let rates = |name: &str| all.iter().find(|r| r.name == name).map(|r| &r.rates);
    for (other, must) in ["plain", "peer"].into_iter().zip(case.must) {
        if let (Some(fast), Some(slow)) = (rates("fast"), rates(other)) {
            let ratio = median(fast.iter().zip(slow).map(|(f, s)| f / s).collect());
            print!("  fast/{other} {ratio:.2} (must {must})");
        }
    }
    println!("  [{notes}]");
    Ok(())
}

/// What a single large sphere costs: the same bed with and without it in turn.
fn intruder(args: &Args, case: &Case, threads: usize) -> Result<(), String> {
    let with = case.with_intruder();
    let mut ratios = vec![];
    for _ in 0..args.rounds {
        // Per step, whatever the number of grains.
        let time = |case: &Case| ours(case, "fast").map(|(lap, _)| lap.seconds(threads));
        ratios.push(time(&with)? / time(case)?);
    }
    let extra = 100.0 * (median(ratios) - 1.0);
    println!(
        "{} {threads} thread(s):  a sphere of ten times the size among {} costs {extra:.1} % (must 10)",
        case.name,
        with.grains.len() - 1
    );
    Ok(())
}

/// Runs the bed with one of our sweeps.
fn ours(case: &Case, sweep: &str) -> Result<(Lap, DemState), String> {
    let mut spec = case.spec.clone();
    spec.search.sweep = match sweep {
        "plain" => Sweep::Plain,
        "fast" => Sweep::Fast,
        other => return Err(format!("there is no sweep `{other}`")),
    };
    let mut dem = Dem::new(spec).map_err(|e| e.to_string())?;
    let mut state = dem.start(&case.grains).map_err(|e| e.to_string())?;
    run(&mut dem, &mut state, 0, case.warm);
    let clock = Clock::start();
    run(&mut dem, &mut state, case.warm, case.steps);
    Ok((clock.lap(), state))
}

fn run(dem: &mut Dem, state: &mut DemState, first: u64, steps: u64) {
    let dt = dem.spec().dt;
    for k in first..first + steps {
        dem.advance(state, Tick::at(k, dt), &FIELD);
    }
}

/// Runs the bed with a peer.
fn peer(command: &str, start: &Path, case: &Case, threads: usize) -> Result<f64, String> {
    let mut words = command.split_whitespace();
    let program = words.next().ok_or("an empty command for the peer")?;
    let numbers = [threads.to_string(), case.warm.to_string(), case.steps.to_string()];
    let output = Command::new(program)
        .args(words)
        .arg(start)
        .arg(case.name.to_string())
        .args(numbers)
        .output()
        .map_err(|e| format!("{program}: {e}"))?;
    let text = String::from_utf8_lossy(&output.stdout);
    text.lines()
        .last()
        .and_then(|line| line.trim().parse().ok())
        .ok_or_else(|| format!("the peer gave no rate:\n{text}{}", String::from_utf8_lossy(&output.stderr)))
}
