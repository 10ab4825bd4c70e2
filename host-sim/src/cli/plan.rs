//! `plan`: plans a move without residual vibration, prints its figures and draws it.

use std::path::{Path, PathBuf};
use std::process::ExitCode;

use serde::Serialize;
use stillbeam::Limits;
use stillbeam::planner::ShortestMove;
use stillbeam_sim::console::open_arm;
use stillbeam_sim::error::Error;
use stillbeam_sim::mechanism::limits::type_in;
use stillbeam_sim::mechanism::{self, MechanismScene};
use stillbeam_sim::plan::{Options, Planned, Request, options, page, shortest};
use stillbeam_sim::scene_file::angle_remark;
use stillbeam_sim::{axis_units, println, progress};

use super::tick::TickArgs;

#[derive(clap::Args)]
pub struct PlanArgs {
    /// Scene file, or the name of an embedded scene: its arm, first angle, limits and tick
    scene: String,
    /// Hub angle at the end, rad (on a linear axis the position, m; likewise below); of a mechanism
    /// the angles of all joints, e.g. 1.0,1.3
    #[arg(long, value_name = "RAD", allow_negative_numbers = true, required = true, num_args = 1)]
    #[arg(value_delimiter = ',')]
    to: Vec<f64>,
    /// Hub angle at the beginning, rad [default: the scene's]
    #[arg(long, value_name = "RAD", allow_negative_numbers = true, num_args = 1)]
    #[arg(value_delimiter = ',')]
    from: Option<Vec<f64>>,
    /// Duration, s [default: the shortest within the limits]
    #[arg(long, value_name = "S", allow_negative_numbers = true)]
    duration: Option<f64>,
    /// Hub rate, rad/s [default: the scene's limit, as with the other limits]; of a mechanism one
    /// value for all joints, or one a joint, e.g. 3,5; likewise below
    #[arg(long, value_name = "RAD/S", allow_negative_numbers = true, num_args = 1)]
    #[arg(value_delimiter = ',')]
    max_rate: Option<Vec<f64>>,
    /// Hub acceleration, rad/s²
    #[arg(long, value_name = "RAD/S2", allow_negative_numbers = true, num_args = 1)]
    #[arg(value_delimiter = ',')]
    max_acceleration: Option<Vec<f64>>,
    /// Hub jerk, rad/s³
    #[arg(long, value_name = "RAD/S3", allow_negative_numbers = true, num_args = 1)]
    #[arg(value_delimiter = ',')]
    max_jerk: Option<Vec<f64>>,
    /// Hub torque, N m
    #[arg(long, value_name = "NM", allow_negative_numbers = true, num_args = 1)]
    #[arg(value_delimiter = ',')]
    max_torque: Option<Vec<f64>>,
    /// Bending moment at the clamp, N m
    #[arg(long, value_name = "NM", allow_negative_numbers = true)]
    max_moment: Option<f64>,
    /// Fraction to which the arm's frequency is known, 0.01 to 0.3: a move that stays still across
    /// it
    #[arg(long, value_name = "FRACTION", allow_negative_numbers = true)]
    robust: Option<f64>,
    /// Residual vibration that may be left, e.g. 0.2mm or 3% of the link's length: what a shortest
    /// move gains by it; with --robust, the largest over the frequencies
    #[arg(long, value_name = "REST")]
    within: Option<String>,
    /// Use of the given duration: least peak `acceleration`, or least `effort`, the integral of the
    /// squared torque [default: a smooth still move]
    #[arg(long, value_name = "WHAT")]
    least: Option<String>,
    /// Begin and end without acceleration though no jerk is limited; a fastest move else begins and
    /// ends with a jump of it
    #[arg(long)]
    eased: bool,
    #[command(flatten)]
    tick: TickArgs,
    /// Folder for the page, its pictures and the run
    #[arg(long, value_name = "DIR", default_value = "plan")]
    out: PathBuf,
    /// Print one JSON object, for programs
    #[arg(long)]
    json: bool,
    /// Show the page in the browser
    #[arg(long)]
    open: bool,
}

impl PlanArgs {
    pub fn execute(self) -> Result<ExitCode, Error> {
        if let Some(scene) = mechanism::scenes::open(&self.scene)? {
            super::mechanism::refuse("--robust", self.robust.is_some())?;
            super::mechanism::refuse("--max-moment", self.max_moment.is_some())?;
            super::mechanism::refuse("--within", self.within.is_some())?;
            super::mechanism::refuse("--least", self.least.is_some())?;
            super::mechanism::refuse("--eased", self.eased)?;
            let scene = self.tick.applied_to_mechanism(scene);
            let limits = self.limits_of_joints(&scene)?;
            let Self { from, to, duration, out, json, open, .. } = self;
            let page = super::mechanism::plan(&scene, from, to, duration, limits, &out, json)?;
            if open {
                super::show(&page);
            }
            return Ok(ExitCode::SUCCESS);
        }
        let scene = self.tick.applied(open_arm(&self.scene)?);
        let to = single("--to", &self.to)?;
        let from = self.from.as_ref().map(|angles| single("--from", angles)).transpose()?;
        for (key, value) in [("--from", from), ("--to", Some(to))] {
            let turns = !scene.arm.mount.is_linear();
            let value = value.filter(|_| turns);
            if let (Some(value), Some(text)) = (value, value.and_then(angle_remark)) {
                super::note(&format!("{key} = {value}: {text}"));
            }
        }
        let limits = scene.limits;
        let typed = |option, values: &Option<Vec<f64>>| {
            values.as_ref().map(|values| single(option, values)).transpose()
        };
        let request = Request {
            arm: scene.arm,
            from: from.unwrap_or(scene.from),
            to,
            duration: self.duration,
            limits: Limits {
                rate: typed("--max-rate", &self.max_rate)?.or(limits.rate),
                acceleration: typed("--max-acceleration", &self.max_acceleration)?
                    .or(limits.acceleration),
                deceleration: limits.deceleration,
                jerk: typed("--max-jerk", &self.max_jerk)?.or(limits.jerk),
                torque: typed("--max-torque", &self.max_torque)?.or(limits.torque),
                moment: self.max_moment.or(limits.moment),
            }
            .validate()?,
            robust: self.robust,
            options: Options {
                residual: self
                    .within
                    .as_deref()
                    .map(|text| options::residual(text, scene.arm.link.length))
                    .transpose()?,
                least: self.least.as_deref().map(options::least).transpose()?,
                eased: self.eased,
            }
            .validate(self.duration)?,
            tick: scene.solver.resolve()?.tick,
        };
        let bar = progress::bar("reference rod", stillbeam_sim::plan::request::ERRORS.len());
        let planned = request.carry_out(&|| bar.inc(1));
        bar.finish_and_clear();
        let planned = planned.map_err(|error| error.on(scene.arm.mount.axis))?;
        // A refusal is one line.
        for line in scene.deduced.lines() {
            super::note(&line);
        }
        let file = page::write(&self.out, &scene.name, &request, &planned)?;
        if self.json {
            let report = PlanReport::of(&scene.name, &request, &planned, &file);
            super::print_json(&report)?;
        } else {
            print(&scene.name, &request, &planned);
            println!("  {}", file.display());
            draw(&request, &planned);
        }
        if self.open {
            super::show(&file);
        }
        Ok(ExitCode::SUCCESS)
    }
}

impl PlanArgs {
    /// Returns the limits of a mechanism's joints: those that are typed, else the scene's.
    fn limits_of_joints(&self, scene: &MechanismScene) -> Result<Vec<Limits>, Error> {
        let mut all = scene.limits.clone();
        let mut set = |option, values: &Option<Vec<f64>>, set| {
            type_in(&mut all, option, values.as_deref(), set)
        };
        set("--max-rate", &self.max_rate, |limits, value| limits.rate = Some(value))?;
        set("--max-acceleration", &self.max_acceleration, |limits, value| {
            limits.acceleration = Some(value);
        })?;
        set("--max-jerk", &self.max_jerk, |limits, value| limits.jerk = Some(value))?;
        set("--max-torque", &self.max_torque, |limits, value| limits.torque = Some(value))?;
        Ok(all)
    }
}

/// Returns the one value of an arm's hub.
fn single(key: &str, values: &[f64]) -> Result<f64, Error> {
    match values {
        [value] => Ok(*value),
        _ => Err(Error::new(format_args!(
            "{key} = {values:?}: must be one value with an arm of one [link]"
        ))),
    }
}

/// Draws deflection and torque of the reference rod over time, if standard output is a terminal.
fn draw(request: &Request, planned: &Planned) {
    let samples = &planned.judgement.samples;
    let end = samples.last().map_or(0.0, |sample| sample.t);
    let rows = (0..=ROWS).map(|k| {
        let at = samples.partition_point(|sample| sample.t < end * k as f64 / ROWS as f64);
        &samples[at.min(samples.len() - 1)]
    });
    let (deflection, torque) = rows.map(|sample| (1e3 * sample.deflection, sample.torque)).unzip();
    let end = (1e3 * end).round() / 1e3;
    let units = axis_units::of(request.arm.mount.axis);
    let effort = format!("{}, {}", units.effort, units.effort_unit);
    super::draw([("deflection, mm", deflection), (effort.as_str(), torque)], end);
}

/// Even times of a small plot.
const ROWS: usize = 120;

/// Figures of a plan, for programs.
#[derive(Serialize)]
struct PlanReport {
    scene: String,
    from: f64,
    to: f64,
    duration_s: f64,
    ticks: u32,
    first_period_s: f64,
    /// Peaks of the hub's motion: rad/s, rad/s², rad/s³; on a linear axis of m.
    peak_rate: f64,
    peak_acceleration: f64,
    /// Absent where the acceleration jumps at both ends.
    peak_jerk: Option<f64>,
    /// Largest torque in the reference rod, N m; on a linear axis the largest force, N.
    peak_effort: f64,
    peak_moment_nm: f64,
    peak_deflection_m: f64,
    /// Residual vibration in the reference rod, fraction of L.
    residual: f64,
    /// Pairs of frequency error and residual, fractions.
    sensitivity: Vec<(f64, f64)>,
    page: PathBuf,
}

impl PlanReport {
    fn of(scene: &str, request: &Request, planned: &Planned, page: &Path) -> Self {
        let Planned { plan, prediction, judgement, loads, .. } = planned;
        Self {
            scene: scene.to_owned(),
            from: request.from,
            to: request.to,
            duration_s: plan.duration(),
            ticks: plan.ticks(),
            first_period_s: planned.first_period,
            peak_rate: plan.peaks().rate,
            peak_acceleration: plan.peaks().acceleration,
            peak_jerk: Some(plan.peaks().jerk).filter(|jerk| jerk.is_finite()),
            peak_effort: loads.torque.value,
            peak_moment_nm: loads.moment.value,
            peak_deflection_m: prediction.deflection,
            residual: judgement.residual,
            sensitivity: planned.sensitivity.clone(),
            page: page.to_owned(),
        }
    }
}

fn print(name: &str, request: &Request, planned: &Planned) {
    let Planned { plan, prediction, judgement, .. } = planned;
    let length = request.arm.link.length;
    let kind = match (request.robust, plan) {
        (Some(spread), ShortestMove::Fastest(_)) => {
            format!("piecewise-linear acceleration, robust to \u{b1}{} %", 100.0 * spread)
        }
        (Some(spread), _) => format!("still, robust to \u{b1}{} %", 100.0 * spread),
        (None, ShortestMove::Fastest(_)) => "still, piecewise-linear acceleration".to_owned(),
        (None, ShortestMove::Still(_)) => "still".to_owned(),
    };
    let periods = plan.duration() / planned.first_period;
    let units = axis_units::of(request.arm.mount.axis);
    println!("{name}: {} to {} {}, {kind}", request.from, request.to, units.position);
    println!(
        "  duration           {:.4} s ({} ticks, {periods:.2} first periods)",
        plan.duration(),
        plan.ticks()
    );
    if let Some(asked) = request.duration.filter(|asked| (asked - plan.duration()).abs() > 1e-9) {
        println!("                     {asked} s was asked for: rounded to whole ticks");
    }
    let bound = shortest::rigid_bound(request.to - request.from, &request.limits, request.tick);
    if let Some(bound) = bound.filter(|_| request.duration.is_none()) {
        println!(
            "                     {:.1} % over the bound: {bound:.4} s, a rigid arm",
            100.0 * (plan.duration() / bound - 1.0)
        );
    }
    let peaks = plan.peaks();
    println!("  peak rate          {:.4} {}", peaks.rate, units.rate);
    println!("  peak acceleration  {:.3} {}", peaks.acceleration, units.acceleration);
    if peaks.jerk.is_finite() {
        println!("  peak jerk          {:.1} {}", peaks.jerk, units.jerk);
    } else {
        println!("  peak jerk          none: the acceleration jumps at both ends");
    }
    println!(
        "  peak {:<12}  {:.4} {} in the reference rod",
        units.effort, planned.loads.torque.value, units.effort_unit
    );
    println!(
        "  peak bending       {:.4} N m at the clamp, in the reference rod",
        planned.loads.moment.value
    );
    println!(
        "  peak deflection    {:.2} mm ({:.1} % of L)",
        1e3 * prediction.deflection,
        100.0 * prediction.deflection / length
    );
    println!("  residual           {:.4} % of L in the reference rod", 100.0 * judgement.residual);
    println!(
        "  planner\u{2019}s bound    {:.4} % of L by its model, all modes in step",
        100.0 * prediction.residual / length
    );
    let at = |error: f64| 100.0 * planned.residual_at(error);
    println!(
        "  frequency off by   -20 % {:.2}, -10 % {:.2}, -5 % {:.2}, +5 % {:.2}, +10 % {:.2}, +20 % {:.2}: % of L",
        at(-0.2),
        at(-0.1),
        at(-0.05),
        at(0.05),
        at(0.1),
        at(0.2)
    );
    println!("  planned in         {} simulations of the move", plan.simulations());
}
