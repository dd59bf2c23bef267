//! Everything that grows while a run goes on: tables, frames, pictures.

use crate::directory::Directory;
use crate::{fields, pictures};
use brazilnut_base::schedule::{Every, Schedule};
use brazilnut_base::values::Values;
use brazilnut_base::{Cell, Table, Tick};
use brazilnut_grains::Grains;
use brazilnut_observe::FlowView;
use brazilnut_report::text::significant;
use brazilnut_sim::Plan;
use brazilnut_store::dump::Dump;
use brazilnut_store::{GrainFrame, Series, StoreError, TableFile, atomic, table, vtk};
use serde::{Deserialize, Serialize};
use std::path::PathBuf;

/// What a checkpoint must remember of the outputs.
#[derive(Clone, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
pub struct Written {
    /// Bytes in each table, by index of the observer; 0 for none.
    pub tables: Vec<u64>,
    /// Bytes in the LAMMPS dump.
    pub dump: u64,
    /// The step boundary that all this belongs to.
    pub step: u64,
}

/// What ParaView reads: each where the run has it.
struct AllSeries {
    grains: Option<Series>,
    fields: Option<Series>,
}

impl AllSeries {
    fn open(
        plan: &Plan,
        open: impl Fn(&str, &str) -> Result<Series, StoreError>,
    ) -> Result<Self, StoreError> {
        Ok(Self {
            grains: (!plan.start.is_empty()).then(|| open("grains", "vtp")).transpose()?,
            fields: plan.flow().map(|_| open("fields", "vti")).transpose()?,
        })
    }
}

/// The open outputs of a run.
pub struct Outputs {
    directory: Directory,
    tables: Vec<Option<TableFile>>,
    series: AllSeries,
    dump: Option<Dump>,
    frames: Schedule,
    fields: Schedule,
    pictures: Vec<u64>,
    flows: Vec<u64>,
    palette: pictures::Palette,
    cell: Cell,
    species_names: Vec<String>,
}

impl Outputs {
    /// New outputs in an empty directory.
    ///
    /// # Errors
    /// If something cannot be written.
    pub fn create(directory: &Directory, plan: &Plan, output: &Values) -> Result<Self, StoreError> {
        for folder in [directory.tables(), directory.pictures()] {
            atomic::make_folder(&folder)?;
        }
        let tables = plan.watches.iter().map(|w| {
            let columns = w.columns();
            if columns.is_empty() {
                return Ok(None);
            }
            TableFile::create(&directory.tables().join(format!("{}.csv", w.name)), &columns).map(Some)
        });
        let tables = tables.collect::<Result<_, _>>()?;
        let series = AllSeries::open(plan, |name, kind| Series::create(&directory.root, name, kind))?;
        let dump = output.flag("dump").then(|| Dump::create(&directory.dump())).transpose()?;
        Ok(Self::assemble(directory, plan, output, tables, series, dump))
    }

    /// The outputs of an earlier part of the run, cut back to `written`.
    ///
    /// # Errors
    /// If something cannot be read back or written.
    pub fn resume(
        directory: &Directory,
        plan: &Plan,
        output: &Values,
        written: &Written,
    ) -> Result<Self, StoreError> {
        let tables = plan.watches.iter().zip(&written.tables).map(|(w, &length)| {
            let columns = w.columns();
            if columns.is_empty() {
                return Ok(None);
            }
            TableFile::resume(&directory.tables().join(format!("{}.csv", w.name)), &columns, length).map(Some)
        });
        let tables = tables.collect::<Result<_, _>>()?;
        let series =
            AllSeries::open(plan, |name, kind| Series::resume(&directory.root, name, kind, written.step))?;
        // A dump that was not asked for before starts here.
        let dump = match (output.flag("dump"), written.dump) {
            (false, _) => None,
            (true, 0) => Some(Dump::create(&directory.dump())?),
            (true, length) => Some(Dump::resume(&directory.dump(), length)?),
        };
        Ok(Self::assemble(directory, plan, output, tables, series, dump))
    }

    fn assemble(
        directory: &Directory,
        plan: &Plan,
        output: &Values,
        tables: Vec<Option<TableFile>>,
        series: AllSeries,
        dump: Option<Dump>,
    ) -> Self {
        let clock = &plan.clock;
        let schedule = |key: &str| {
            let every = output.every_opt(key).unwrap_or(Every::End);
            Schedule::new(every, 0.0, clock.dt, clock.steps_per_cycle, clock.end)
                .unwrap_or(Schedule { period: u64::MAX, offset: clock.end })
        };
        let n = if plan.start.is_empty() { 0 } else { output.integer("pictures").max(0) as u64 };
        let pictures = match n {
            0 => vec![],
            1 => vec![clock.end],
            _ => (0..n).map(|k| clock.end * k / (n - 1)).collect(),
        };
        Self {
            directory: directory.clone(),
            tables,
            series,
            dump,
            frames: schedule("frames"),
            fields: schedule("fields"),
            flows: if pictures.is_empty() { vec![] } else { flow_pictures(plan, &pictures) },
            pictures,
            palette: pictures::Palette::new(plan),
            cell: plan.cell,
            species_names: plan.species.iter().map(|s| s.name.clone()).collect(),
        }
    }

    /// Appends a row to the table of observer `k`.
    ///
    /// # Errors
    /// If it cannot be written.
    pub fn row(&mut self, k: usize, values: &[f64]) -> Result<(), StoreError> {
        self.tables[k].as_mut().map_or(Ok(()), |t| t.append(values))
    }

    /// Whether grains are wanted at this boundary.
    #[must_use]
    pub fn wants_grains(&self, tick: &Tick) -> bool {
        let due = |list: &[u64]| list.contains(&tick.index);
        self.series.grains.is_some()
            && (tick.index == 0 || self.frames.is_due(tick.index) || due(&self.pictures) || due(&self.flows))
    }

    /// Writes the frame and the picture that are due at this boundary. The
    /// initial frame is always written.
    ///
    /// # Errors
    /// If they cannot be written.
    pub fn frame(
        &mut self,
        tick: &Tick,
        grains: &Grains,
        flow: Option<&dyn FlowView>,
        caption: &str,
    ) -> Result<(), StoreError> {
        if tick.index == 0 {
            self.palette.start(grains);
        }
        if tick.index == 0 || self.frames.is_due(tick.index) {
            let id: Vec<u64> = (0..grains.len() as u64).collect();
            let species: Vec<u64> = grains.species.iter().map(|&s| u64::from(s)).collect();
            let frame = GrainFrame {
                step: tick.index,
                time: tick.time,
                cell: &self.cell,
                species_names: &self.species_names,
                id: &id,
                species: &species,
                position: &grains.position,
                velocity: &grains.velocity,
                angular_velocity: &grains.angular_velocity,
                radius: &grains.radius,
                extra: &[],
            };
            if let Some(series) = &mut self.series.grains {
                vtk::write_grains(&series.frame(tick.index), &frame, vtk::Precision::Single)?;
                series.add(tick.index, tick.time)?;
            }
            if let Some(dump) = &mut self.dump {
                dump.append(&frame)?;
            }
        }
        if self.pictures.contains(&tick.index) {
            let png = self.palette.picture(&self.cell, grains);
            let stem = self.directory.pictures().join(format!("bed-{:012}", tick.index));
            atomic::write(&stem.with_extension("png"), &png)?;
            atomic::write(&stem.with_extension("txt"), caption.as_bytes())?;
        }
        match flow {
            Some(flow) if self.flows.contains(&tick.index) => self.flow_picture(tick, grains, flow, caption),
            _ => Ok(()),
        }
    }

    /// The flow at this boundary: the bed cut open, and fluid and grains side by side.
    fn flow_picture(
        &self,
        tick: &Tick,
        grains: &Grains,
        flow: &dyn FlowView,
        caption: &str,
    ) -> Result<(), StoreError> {
        let stem = self.directory.pictures().join(format!("flow-{:012}", tick.index));
        let (png, fastest) = self.palette.flow_picture(&self.cell, grains, flow);
        atomic::write(&stem.with_extension("png"), &png)?;
        let text = format!("{caption}, longest arrow {} mm/s", significant(1e3 * fastest, 3));
        atomic::write(&stem.with_extension("txt"), text.as_bytes())?;
        let figures = self.palette.plane(&self.cell).figures(grains, flow, caption);
        atomic::write(&stem.with_extension("json"), &serde_json::to_vec(&figures).expect("plain data"))
    }

    /// Writes the flow, if there is one, for ParaView.
    ///
    /// # Errors
    /// If it cannot be written.
    pub fn flow(&mut self, tick: &Tick, flow: Option<&dyn FlowView>) -> Result<(), StoreError> {
        let (Some(series), Some(flow)) = (&mut self.series.fields, flow) else { return Ok(()) };
        fields::write(&series.frame(tick.index), tick.time, &self.cell, flow)?;
        series.add(tick.index, tick.time)
    }

    /// Whether the flow is wanted at this boundary.
    #[must_use]
    pub fn wants_flow(&self, tick: &Tick) -> bool {
        self.series.fields.is_some() && self.fields.is_due(tick.index)
    }

    /// Brings all to the disk and says what a checkpoint must remember.
    ///
    /// # Errors
    /// If the disk says no.
    pub fn written(&self, step: u64) -> Result<Written, StoreError> {
        let mut tables = vec![];
        for t in &self.tables {
            if let Some(t) = t {
                t.sync()?;
            }
            tables.push(t.as_ref().map_or(0, TableFile::length));
        }
        if let Some(dump) = &self.dump {
            dump.sync()?;
        }
        let dump = self.dump.as_ref().map_or(0, Dump::length);
        Ok(Written { tables, dump, step })
    }

    /// The palette, for a resumed run to colour as the first did.
    #[must_use]
    pub fn palette(&self) -> &pictures::Palette {
        &self.palette
    }

    /// Takes over the palette of an earlier part of the run.
    pub fn set_palette(&mut self, palette: pictures::Palette) {
        self.palette = palette;
    }

    /// The series of observer `k` as written so far.
    ///
    /// # Errors
    /// If it cannot be read back.
    pub fn series(&self, plan: &Plan, k: usize) -> Result<Table, StoreError> {
        match &self.tables[k] {
            Some(_) => table::read(&self.path(plan, k)),
            None => Ok(Table::default()),
        }
    }

    fn path(&self, plan: &Plan, k: usize) -> PathBuf {
        self.directory.tables().join(format!("{}.csv", plan.watches[k].name))
    }
}

/// Boundaries at which the flow is drawn: in the last whole cycle while the bed goes up and while it comes
/// down (135 and 225 degrees, Clément Figs 4.6-4.9), or with the `pictures` where nothing shakes.
fn flow_pictures(plan: &Plan, pictures: &[u64]) -> Vec<u64> {
    let clock = &plan.clock;
    match clock.steps_per_cycle {
        _ if plan.flow().is_none() || plan.start.is_empty() => vec![],
        Some(n) if clock.end >= n => {
            let last = (clock.end / n - 1) * n;
            [3, 5].map(|eighths| last + eighths * n / 8).to_vec()
        }
        _ => pictures.iter().copied().filter(|&k| k > 0).collect(),
    }
}
