//! Files that the study writes: CSVs and the report.

use std::path::{Path, PathBuf};

use stillbeam::AxisKind;

use super::mechanisms::Pair;
use super::{Run, Study};
use crate::error::Error;
use crate::mechanism;
use crate::output::Files;
use crate::plan::picture;
use crate::table::Row;
use crate::{report, table};

/// Name of the report.
pub const REPORT: &str = "report.html";

/// Columns of numbers and the file for them.
struct Columns {
    file: &'static str,
    header: Vec<String>,
    rows: Vec<Vec<f64>>,
}

impl Columns {
    fn new(file: &'static str, header: &[&str], rows: Vec<Vec<f64>>) -> Self {
        Self { file, header: header.iter().map(|&name| name.to_owned()).collect(), rows }
    }
}

impl Study {
    /// Refuses a path that cannot be a folder.
    pub fn check_folder(folder: &Path) -> Result<(), Error> {
        match folder.ancestors().find(|path| path.is_file()) {
            Some(path) => Err(Error::new(format_args!(
                "--out = {}: {} is a file; must be a folder, made if it does not exist",
                folder.display(),
                path.display()
            ))),
            None => Ok(()),
        }
    }

    /// Writes the CSVs and the report, all of them or none. Returns their paths, the report first.
    pub fn write(&self, folder: &Path) -> Result<Vec<PathBuf>, Error> {
        Self::check_folder(folder)?;
        let page = report::render(self)?;
        let report = folder.join(REPORT);
        let mut files = Files::default();
        files.add(&report, |file| file.write_all(page.as_bytes()))?;
        for columns in self.columns() {
            let path = folder.join(columns.file);
            let header: Vec<&str> = columns.header.iter().map(String::as_str).collect();
            table::add_columns(&mut files, &path, &header, &columns.rows)?;
        }
        let path = folder.join("setpoints.csv");
        table::add(&mut files, &path, AxisKind::Rotary, &self.setpoints.flexible.rows)?;
        files.finish()
    }

    fn columns(&self) -> Vec<Columns> {
        vec![
            self.tip_path_columns(),
            self.element_columns(),
            self.period_columns(),
            self.step_columns(),
            self.step_error_columns(),
            self.member_columns(),
            self.member_summary(),
            self.profile_columns(),
            self.stillness_columns(),
            self.swing_columns(),
            pair_columns("mechanisms-open.csv", &self.mechanisms.open, "rod"),
            pair_columns("mechanisms-closing.csv", &self.mechanisms.closing, "fine"),
            pair_columns("mechanisms-loop.csv", &self.mechanisms.looped, "rigid"),
        ]
    }

    fn tip_path_columns(&self) -> Columns {
        let pairs = self.tip_path.rigid.rows.iter().zip(&self.tip_path.flexible.rows);
        let rows = pairs.map(|(rigid, flexible)| {
            vec![rigid.t_s, rigid.tip_x_m, rigid.tip_y_m, flexible.tip_x_m, flexible.tip_y_m]
        });
        let header = ["t_s", "rigid_x_m", "rigid_y_m", "flexible_x_m", "flexible_y_m"];
        Columns::new("fig1-tip-path.csv", &header, rows.collect())
    }

    fn element_columns(&self) -> Columns {
        let meshes = || self.elements.meshes.iter();
        let lumped = meshes().map(|mesh| (format!("lumped_{}", mesh.elements), &mesh.lumped.run));
        let consistent =
            meshes().map(|mesh| (format!("consistent_{}", mesh.elements), &mesh.consistent.run));
        side_by_side("fig2-elements.csv", &lumped.chain(consistent).collect::<Vec<_>>())
    }

    fn period_columns(&self) -> Columns {
        let row = |mesh: &super::elements::Mesh| {
            vec![mesh.elements as f64, mesh.lumped.period, mesh.consistent.period]
        };
        let header = ["elements", "lumped_period_s", "consistent_period_s"];
        let rows = self.elements.meshes.iter().map(row).collect();
        Columns::new("fig2-periods.csv", &header, rows)
    }

    fn step_columns(&self) -> Columns {
        let runs = self.steps.steps.iter().map(|step| &step.run);
        let rows = std::iter::once(&self.steps.finest).chain(runs).flat_map(|run| {
            let row = |row: &Row| vec![run.solver.tick, row.t_s, row.tip_x_m, row.deflection_m];
            run.rows.iter().map(row)
        });
        Columns::new(
            "fig5-steps.csv",
            &["step_s", "t_s", "tip_x_m", "deflection_m"],
            rows.collect(),
        )
    }

    fn step_error_columns(&self) -> Columns {
        let row = |step: &super::steps::Step| {
            vec![step.run.solver.tick, step.tip_max, step.tip_rms, step.residual]
        };
        let header = ["step_s", "tip_error_max_l", "tip_error_rms_l", "residual_l"];
        Columns::new("fig5-errors.csv", &header, self.steps.steps.iter().map(row).collect())
    }

    fn member_columns(&self) -> Columns {
        let runs = self.members.members.iter().flat_map(|member| {
            [
                (format!("{}_undamped", member.name), &member.undamped.run),
                (format!("{}_damped", member.name), &member.damped.run),
            ]
        });
        side_by_side("fig6-members.csv", &runs.collect::<Vec<_>>())
    }

    fn member_summary(&self) -> Columns {
        let row = |member: &super::members::Member| {
            let link = member.undamped.run.scene.arm.link;
            vec![
                link.mass,
                link.bending_stiffness,
                member.period,
                member.undamped.peak,
                member.undamped.residual,
                member.damped.peak,
                member.damped.residual,
            ]
        };
        let header = [
            "link_mass_kg",
            "bending_stiffness_nm2",
            "first_period_s",
            "undamped_peak_l",
            "undamped_residual_l",
            "damped_peak_l",
            "damped_residual_l",
        ];
        Columns::new("fig6-summary.csv", &header, self.members.members.iter().map(row).collect())
    }

    fn stillness_columns(&self) -> Columns {
        let curves = self.stillness.curves.iter();
        let curves = curves.map(|curve| (column(&curve.motion), &curve.points[..]));
        residual_columns("stillness.csv", "frequency_error", curves)
    }

    fn swing_columns(&self) -> Columns {
        let entries: Vec<_> = picture::swung(&self.stillness.entries).collect();
        let header = entries.iter().flat_map(|entry| {
            let name = column(&entry.name);
            [format!("t_{name}_s"), format!("deflection_{name}_m")]
        });
        // A shaped motion may last a tick less, and has a row or two less.
        let samples = || entries.iter().map(|entry| &entry.nominal().samples);
        let count = samples().map(|samples| samples.len()).min().unwrap_or(0);
        let row = |k: usize| samples().flat_map(|all| [all[k].t, all[k].deflection]).collect();
        let rows = (0..count).map(row).collect();
        Columns { file: "stillness-swing.csv", header: header.collect(), rows }
    }

    fn profile_columns(&self) -> Columns {
        let curves = self.profiles.curves.iter();
        let curves = curves.map(|curve| (curve.profile.name().to_owned(), &curve.points[..]));
        residual_columns("profiles.csv", "duration_periods", curves)
    }
}

/// Returns residuals, fraction of L, over what they share: a column a curve, by name.
fn residual_columns<'a>(
    file: &'static str,
    over: &str,
    curves: impl Iterator<Item = (String, &'a [(f64, f64)])> + Clone,
) -> Columns {
    let names = curves.clone().map(|(name, _)| format!("residual_{name}_l"));
    let header = std::iter::once(over.to_owned()).chain(names).collect();
    let points = || curves.clone().map(|(_, points)| points);
    let row = |(k, &(x, _)): (usize, &(f64, f64))| {
        std::iter::once(x).chain(points().map(|points| points[k].1)).collect()
    };
    let shared = points().next().unwrap_or_default();
    Columns { file, header, rows: shared.iter().enumerate().map(row).collect() }
}

/// Returns the flexible run of a mechanism and the torques of the other one.
fn pair_columns(file: &'static str, pair: &Pair, other: &str) -> Columns {
    let count = pair.scene.mechanism.links.len();
    let mut header = mechanism::table::columns(count);
    header.extend((1..=count).map(|j| format!("torque{j}_{other}_nm")));
    let row = |(own, other): (&mechanism::table::Row, &mechanism::table::Row)| {
        own.values().into_iter().chain(other.torques.iter().copied()).collect()
    };
    Columns { file, header, rows: pair.flexible.iter().zip(&pair.other).map(row).collect() }
}

/// Converts a motion's name to a part of a column's name.
fn column(name: &str) -> String {
    let word = |part: &str| part.to_lowercase().replace(|c: char| !c.is_ascii_alphanumeric(), "");
    name.split([' ', ',']).map(word).filter(|part| !part.is_empty()).collect::<Vec<_>>().join("_")
}

/// Returns tip X and deflection of named runs with the same ticks, two columns each.
fn side_by_side(file: &'static str, runs: &[(String, &Run)]) -> Columns {
    let names = runs
        .iter()
        .flat_map(|(name, _)| [format!("tip_x_{name}_m"), format!("deflection_{name}_m")]);
    let header = std::iter::once("t_s".to_owned()).chain(names).collect();
    let count = runs.first().map_or(0, |(_, run)| run.rows.len());
    let row = |k: usize| {
        let values = runs.iter().flat_map(|(_, run)| {
            let row = &run.rows[k];
            [row.tip_x_m, row.deflection_m]
        });
        std::iter::once(runs[0].1.rows[k].t_s).chain(values).collect()
    };
    Columns { file, header, rows: (0..count).map(row).collect() }
}
