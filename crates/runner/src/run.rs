//! Running a case that moves grains, from the first step to the report.

use crate::analytic;
use crate::directory::Directory;
use crate::failure::Failure;
use crate::outputs::{Outputs, Written};
use crate::pictures::Palette;
use crate::progress::{Look, Progress};
use crate::report::{self, Shown};
use crate::sheet;
use crate::status::{Status, commit};
use crate::stop::{Early, Watch};
use brazilnut_base::Tick;
use brazilnut_case::build::Built;
use brazilnut_case::{Case, build, check, resolved};
use brazilnut_coupling::Measured;
use brazilnut_observe::FlowView;
use brazilnut_report::sheet::Sheet;
use brazilnut_sim::plan::Medium;
use brazilnut_sim::{Ended, Simulation, Stage, State, view};
use brazilnut_store::checkpoint::{self, Header};
use brazilnut_store::lock::Lock;
use brazilnut_store::{StoreError, atomic, table};
use serde::{Deserialize, Serialize};
use std::collections::{BTreeMap, BTreeSet};
use std::path::{Path, PathBuf};
use std::time::{Duration, Instant};

/// What the command line adds to a case.
#[derive(Clone, Debug, Default)]
pub struct Options {
    /// The run directory; `runs/NAME` by default.
    pub out: Option<PathBuf>,
    /// Replace a run that is there already.
    pub replace: bool,
    /// Number of threads; all processors by default.
    pub threads: Option<usize>,
    /// No progress.
    pub quiet: bool,
    /// Stop with a checkpoint after this wall-clock time.
    pub wall_limit: Option<Duration>,
    /// Stop with a checkpoint after this many steps since time 0 (for tests and crash drills).
    pub stop_after: Option<u64>,
    /// A resumed run ends then instead of at its case's `time.end`.
    pub until: Option<String>,
}

/// How a run ended without failing.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Outcome {
    /// At the end of the plan.
    Done,
    /// Early, with a good checkpoint.
    Stopped(Early),
}

impl Outcome {
    /// The exit code of the process.
    #[must_use]
    pub fn exit_code(self) -> u8 {
        match self {
            Self::Done => 0,
            Self::Stopped(Early::WallLimit) => 4,
            Self::Stopped(Early::Signal) => 130,
        }
    }
}

/// What a checkpoint holds.
#[derive(Serialize, Deserialize)]
struct Saved {
    /// The case, key by key, to tell what was edited since.
    case: BTreeMap<String, String>,
    state: State,
    written: Written,
    palette: Palette,
}

/// Runs `case` into its directory.
///
/// # Errors
/// What is wrong with the case, a blow-up, or a file that cannot be written.
pub fn run(case: &Case, options: &Options) -> Result<Outcome, Failure> {
    if check::is_analytical(case.model()) {
        return analytic::run(case, options).map(|()| Outcome::Done);
    }
    let built = build::build(case)?;
    let directory = Directory::new(&options.out.clone().unwrap_or_else(|| default_out(case)));
    let sheet = sheet::sheet(case.values.text("title"), case.model(), &built);
    let simulation = Simulation::new(built.plan.clone()).map_err(|e| refused(case, &e))?;
    make_root(&directory)?;
    let _lock = Lock::take(&directory.root)?;
    directory.claim(options.replace)?;
    atomic::write(&directory.case(), case.resolved().as_bytes())?;
    let output = case.values.table_opt("output").expect("has a default");
    let outputs = Outputs::create(&directory, simulation.plan(), output)?;
    let job = Job::new(case, &directory, sheet, simulation, outputs, options);
    job.carry_out()
}

/// Continues the run in `root` to its end, or to another end if `options` name one.
///
/// # Errors
/// As [`run`]; also if there is no whole checkpoint, the case was edited, or the checkpoint lies beyond the end.
pub fn resume(root: &Path, options: &Options) -> Result<Outcome, Failure> {
    let directory = Directory::new(root);
    let end: Vec<String> = options.until.iter().map(|t| format!("time.end={t}")).collect();
    let case = Case::load(&directory.case(), &end)?;
    let _lock = Lock::take(&directory.root)?;
    let found = checkpoint::load_latest::<Saved>(&directory.checkpoints(), checkpoint::Limits::default())?;
    let Built { plan, .. } = &build::build(&case)?;
    let saved = found.state;
    let edited = edits(&saved.case, &resolved::flatten(&case.values));
    if !edited.is_empty() {
        return Err(Failure::Usage(format!(
            "{} was edited since the checkpoint, in what the run depends on:\n  {}\n  remedy: undo the edit, or start a new run",
            directory.case().display(),
            edited.join("\n  ")
        )));
    }
    if saved.state.stage == Stage::Running && saved.state.step > plan.clock.end {
        return Err(Failure::Usage(format!(
            "the checkpoint of {} stands at {} s, beyond the end at {} s\n  remedy: a later `--until` or `time.end`",
            root.display(),
            saved.state.step as f64 * plan.clock.dt,
            plan.clock.end as f64 * plan.clock.dt
        )));
    }
    if options.until.is_some() {
        atomic::write(&directory.case(), case.resolved().as_bytes())?;
    }
    let sheet = sheet::sheet(case.values.text("title"), case.model(), &build::build(&case)?);
    let output = case.values.table_opt("output").expect("has a default");
    let mut outputs = Outputs::resume(&directory, plan, output, &saved.written)?;
    outputs.set_palette(saved.palette);
    let simulation = Simulation::resume(plan.clone(), saved.state).map_err(|e| refused(&case, &e))?;
    let mut job = Job::new(&case, &directory, sheet, simulation, outputs, options);
    job.warnings.extend(
        found
            .refused
            .into_iter()
            .map(|r| format!("the checkpoint {} was not used: {}", r.path.display(), r.reason)),
    );
    job.resumed = true;
    job.carry_out()
}

/// Keys that differ between the case of a checkpoint and the present one.
/// Title, output and end may change: no state depends on them.
fn edits(then: &BTreeMap<String, String>, now: &BTreeMap<String, String>) -> Vec<String> {
    let free = |k: &str| k == "title" || k.starts_with("output.") || k == "time.end";
    let keys: BTreeSet<&String> = then.keys().chain(now.keys()).filter(|k| !free(k)).collect();
    let shown =
        |m: &BTreeMap<String, String>, k: &str| m.get(k).map_or("(not set)".to_string(), Clone::clone);
    keys.into_iter()
        .filter(|k| then.get(*k) != now.get(*k))
        .map(|k| format!("{k}: {} then, {} now", shown(then, k), shown(now, k)))
        .collect()
}

fn refused(case: &Case, e: &brazilnut_grains::SpecError) -> Failure {
    let mut issues = case.issues();
    let span = case.values.table_opt("contact").and_then(|c| c.span.clone());
    issues.add(
        span,
        format!("`{}` cannot be used like this", e.what),
        e.why.clone(),
        "see `brazilnut describe contact`",
    );
    Failure::from(issues)
}

/// The run directory itself. Asking for one that cannot be had is wrong input, not a failure under way.
pub(crate) fn make_root(directory: &Directory) -> Result<(), Failure> {
    atomic::make_folder(&directory.root)
        .map_err(|e| Failure::Usage(format!("{e}\n  remedy: choose another --out")))
}

/// `runs/NAME` for a case file `NAME.toml`.
#[must_use]
pub fn default_out(case: &Case) -> PathBuf {
    let stem = Path::new(&case.path).file_stem().map_or_else(|| "case".into(), |s| s.to_os_string());
    Path::new("runs").join(stem)
}

/// A run under way.
struct Job<'a> {
    case: &'a Case,
    keys: BTreeMap<String, String>,
    directory: &'a Directory,
    sheet: Sheet,
    simulation: Simulation,
    outputs: Outputs,
    options: &'a Options,
    progress: Progress,
    warnings: Vec<String>,
    resumed: bool,
    begun: Instant,
    first_step: u64,
    spent: Spent,
}

/// Wall-clock time by stage, s.
#[derive(Default)]
struct Spent {
    settling: f64,
    stepping: f64,
    observing: f64,
    writing: f64,
}

/// Steps between two looks at the clock, the signals and the progress.
const STRIDE: u64 = 64;

impl<'a> Job<'a> {
    fn new(
        case: &'a Case,
        directory: &'a Directory,
        sheet: Sheet,
        simulation: Simulation,
        outputs: Outputs,
        options: &'a Options,
    ) -> Self {
        let first_step = simulation.state().step;
        Self {
            case,
            keys: resolved::flatten(&case.values),
            directory,
            sheet,
            simulation,
            outputs,
            options,
            progress: Progress::new(options.quiet),
            warnings: vec![],
            resumed: false,
            begun: Instant::now(),
            first_step,
            spent: Spent::default(),
        }
    }

    fn carry_out(mut self) -> Result<Outcome, Failure> {
        let ended = self.advance();
        self.progress.finish();
        match ended {
            Ok(outcome) => {
                let name = match outcome {
                    Outcome::Done => "done",
                    Outcome::Stopped(Early::WallLimit) => "stopped",
                    Outcome::Stopped(Early::Signal) => "interrupted",
                };
                self.finish(name, None)?;
                Ok(outcome)
            }
            Err(Failure::Blowup(b)) => {
                self.finish("blown-up", Some(b.to_string()))?;
                Err(Failure::Blowup(b))
            }
            Err(e) => Err(e),
        }
    }

    /// Steps to the end, or to a reason to stop.
    fn advance(&mut self) -> Result<Outcome, Failure> {
        let output = self.case.values.table_opt("output").expect("has a default");
        let (pause, keep) = (output.number("checkpoint"), output.integer("keep") as usize);
        let watch = Watch::new(self.options.wall_limit)
            .map_err(|e| Failure::Usage(format!("signals cannot be caught: {e}")))?;
        self.status("running", None)?.write(self.directory)?;
        let mut saved = Instant::now();
        if !self.resumed && self.simulation.state().stage == Stage::Running {
            self.boundary()?;
        }
        while self.simulation.ended() == Ended::No {
            let stop_now = self.stretch()?;
            self.show();
            let early = if stop_now { Some(Early::WallLimit) } else { watch.early() };
            if early.is_some() || saved.elapsed().as_secs_f64() >= pause {
                self.save(keep)?;
                saved = Instant::now();
            }
            if let Some(early) = early {
                return Ok(Outcome::Stopped(early));
            }
        }
        self.save(keep)?;
        Ok(Outcome::Done)
    }

    /// Up to [`STRIDE`] steps; whether the step to stop after was reached.
    fn stretch(&mut self) -> Result<bool, Failure> {
        let start = Instant::now();
        let elsewhere = self.spent.observing + self.spent.writing;
        let settling = self.simulation.state().stage != Stage::Running;
        let mut stop_now = false;
        for _ in 0..STRIDE {
            self.simulation.step()?;
            if self.simulation.state().stage == Stage::Running {
                self.boundary()?;
                stop_now = self.options.stop_after.is_some_and(|n| self.simulation.state().step >= n);
            }
            // The stages are timed apart, so a stretch ends where settling does.
            let over = settling && self.simulation.state().stage == Stage::Running;
            if stop_now || over || self.simulation.ended() == Ended::Yes {
                break;
            }
        }
        let here = start.elapsed().as_secs_f64() - (self.spent.observing + self.spent.writing - elsewhere);
        *(if settling { &mut self.spent.settling } else { &mut self.spent.stepping }) += here;
        if settling && self.simulation.state().stage == Stage::Running {
            self.first_step = 0;
        }
        Ok(stop_now)
    }

    /// What belongs to a step boundary: samples, frames, pictures.
    fn boundary(&mut self) -> Result<(), StoreError> {
        if self.simulation.is_sample_due() {
            let start = Instant::now();
            let Self { simulation, outputs, .. } = self;
            simulation.sample(|k, row| outputs.row(k, row))?;
            self.spent.observing += start.elapsed().as_secs_f64();
        }
        let tick = self.simulation.tick();
        if self.outputs.wants_grains(&tick) {
            let start = Instant::now();
            let caption = self.caption(&tick);
            let (grains, flow) = self.simulation.look();
            self.outputs.frame(&tick, grains, flow.as_ref().map(|f| f as &dyn FlowView), &caption)?;
            self.spent.writing += start.elapsed().as_secs_f64();
        }
        if self.outputs.wants_flow(&tick) {
            let start = Instant::now();
            let Self { simulation, outputs, .. } = self;
            outputs.flow(&tick, simulation.look().1.as_ref().map(|f| f as &dyn FlowView))?;
            self.spent.writing += start.elapsed().as_secs_f64();
        }
        Ok(())
    }

    fn caption(&self, tick: &Tick) -> String {
        let cycle = self.simulation.plan().frequency().map(|f| format!(", cycle {:.1}", tick.time * f));
        format!("t = {:.3} s{}", tick.time, cycle.unwrap_or_default())
    }

    fn save(&mut self, keep: usize) -> Result<(), StoreError> {
        let start = Instant::now();
        let state = self.simulation.state();
        let step = state.settled_after + state.step;
        let header = Header {
            what: self.case.model().into(),
            step,
            time: self.simulation.tick().time,
            case_hash: blake3::hash(self.case.resolved().as_bytes()).to_hex().to_string(),
            code_version: env!("CARGO_PKG_VERSION").into(),
        };
        let saved = SavedRef {
            case: &self.keys,
            state,
            written: self.outputs.written(state.step)?,
            palette: self.outputs.palette(),
        };
        let _ = checkpoint::save(&self.directory.checkpoints(), &header, &saved, keep)?;
        self.spent.writing += start.elapsed().as_secs_f64();
        Ok(())
    }

    fn show(&mut self) {
        let (state, plan) = (self.simulation.state(), self.simulation.plan());
        let running = state.stage == Stage::Running;
        let wall = if running { self.spent.stepping + self.spent.observing } else { self.spent.settling };
        let look = Look {
            stage: if running { "shaking" } else { "settling" },
            time: state.step as f64 * plan.clock.dt,
            phase: plan
                .frequency()
                .filter(|_| running)
                .map(|f| 360.0 * (self.simulation.tick().time * f).rem_euclid(1.0)),
            done: if running { state.step as f64 / plan.clock.end as f64 } else { 0.0 },
            steps_per_second: (state.step - if running { self.first_step.min(state.step) } else { 0 }) as f64
                / wall.max(1e-9),
            residual: running.then_some(state.largest_residual),
        };
        self.progress.show(&look);
    }

    fn status(&self, name: &str, error: Option<String>) -> Result<Status, StoreError> {
        let (state, plan) = (self.simulation.state(), self.simulation.plan());
        let running = state.stage == Stage::Running;
        let wall = self.begun.elapsed().as_secs_f64();
        let steps = if running { state.step - self.first_step.min(state.step) } else { 0 };
        let per_second = steps as f64 / self.spent.stepping.max(1e-9);
        let grains = plan.start.len();
        let energy = view::ledger(&self.simulation.ledger());
        let measured = match (&plan.medium, &state.coupling) {
            (Medium::Coupled(spec, _), Some(coupling)) => Measured::of(spec, coupling),
            _ => Measured::default(),
        };
        let timing = [
            ("settling", self.spent.settling),
            ("stepping", self.spent.stepping),
            ("observing", self.spent.observing),
            ("writing", self.spent.writing),
        ];
        Ok(Status {
            status: name.into(),
            title: self.case.values.text("title").into(),
            model: self.case.model().into(),
            version: env!("CARGO_PKG_VERSION").into(),
            commit: commit(),
            seed: self.case.values.integer("seed"),
            threads: rayon::current_num_threads(),
            grains,
            step: if running { state.step } else { 0 },
            steps: plan.clock.end,
            settling_steps: state.settled_after,
            time: if running { state.step as f64 * plan.clock.dt } else { 0.0 },
            wall_seconds: wall,
            steps_per_second: per_second,
            million_particle_steps_per_second: 1e-6 * per_second * grains as f64 * plan.clock.substeps as f64,
            largest_overlap: state.largest_overlap,
            largest_energy_residual: state.largest_residual,
            energy: energy.iter().map(|(k, v)| ((*k).to_string(), *v)).collect(),
            coupling: measured.numbers.iter().map(|(k, v)| ((*k).to_string(), *v)).collect(),
            timing: timing.iter().map(|(k, v)| ((*k).to_string(), *v)).collect(),
            warnings: self
                .warnings
                .iter()
                .chain(self.simulation.warnings())
                .chain(&measured.warnings)
                .cloned()
                .collect(),
            error,
        })
    }

    /// Results, report and status of a run that has ended, however.
    fn finish(&mut self, name: &str, error: Option<String>) -> Result<(), StoreError> {
        let plan = self.simulation.plan();
        let mut shown = vec![];
        for (k, watch) in self.simulation.state().watches.iter().enumerate() {
            let series = self.outputs.series(plan, k)?;
            let results = watch.results();
            for (result, t) in &results {
                table::write(&self.directory.tables().join(format!("{}-{result}.csv", watch.name)), t)?;
            }
            let mut summary = watch.observer().entry().summary.to_string();
            if watch.samples() == 0 {
                summary.push_str(" No samples: the run ended before the first was due.");
            }
            shown.push(Shown {
                name: watch.name.clone(),
                summary,
                figures: watch.figures(&series),
                results: results.into_iter().map(|(r, t)| (format!("{}-{r}", watch.name), t)).collect(),
            });
        }
        let status = self.status(name, error)?;
        report::write(self.directory, &status, &self.sheet, &shown)?;
        status.write(self.directory)
    }
}

/// [`Saved`], borrowed.
#[derive(Serialize)]
struct SavedRef<'a> {
    case: &'a BTreeMap<String, String>,
    state: &'a State,
    written: Written,
    palette: &'a Palette,
}
