//! `plan`: plans a move without residual vibration, prints its figures and draws it.

use std::path::PathBuf;
use std::process::ExitCode;

use stillbeam::Limits;
use stillbeam::planner::ShortestMove;
use stillbeam_sim::console::open_arm;
use stillbeam_sim::error::Error;
use stillbeam_sim::plan::{Planned, Request, page, shortest};
use stillbeam_sim::scene_file::angle_remark;
use stillbeam_sim::{axis_units, println, progress};

#[derive(clap::Args)]
pub struct PlanArgs {
    /// Scene file, or the name of an embedded scene: its arm, first angle, limits and tick
    scene: String,
    /// Hub angle at the end, rad (on a linear axis the position, m; likewise below)
    #[arg(long, value_name = "RAD", allow_negative_numbers = true)]
    to: f64,
    /// Hub angle at the beginning, rad [default: the scene's]
    #[arg(long, value_name = "RAD", allow_negative_numbers = true)]
    from: Option<f64>,
    /// Duration, s [default: the shortest within the limits]
    #[arg(long, value_name = "S", allow_negative_numbers = true)]
    duration: Option<f64>,
    /// Hub rate, rad/s [default: the scene's limit, as with the other limits]
    #[arg(long, value_name = "RAD/S", allow_negative_numbers = true)]
    max_rate: Option<f64>,
    /// Hub acceleration, rad/s²
    #[arg(long, value_name = "RAD/S2", allow_negative_numbers = true)]
    max_acceleration: Option<f64>,
    /// Hub jerk, rad/s³
    #[arg(long, value_name = "RAD/S3", allow_negative_numbers = true)]
    max_jerk: Option<f64>,
    /// Hub torque, N m
    #[arg(long, value_name = "NM", allow_negative_numbers = true)]
    max_torque: Option<f64>,
    /// Bending moment at the clamp, N m
    #[arg(long, value_name = "NM", allow_negative_numbers = true)]
    max_moment: Option<f64>,
    /// Fraction to which the arm's frequency is known, 0.01 to 0.3: a move that stays still across
    /// it
    #[arg(long, value_name = "FRACTION", allow_negative_numbers = true)]
    robust: Option<f64>,
    /// Folder for the page, its pictures and the run
    #[arg(long, value_name = "DIR", default_value = "plan")]
    out: PathBuf,
}

impl PlanArgs {
    pub fn execute(self) -> Result<ExitCode, Error> {
        let scene = open_arm(&self.scene)?;
        for (key, value) in [("--from", self.from), ("--to", Some(self.to))] {
            let turns = !scene.arm.mount.is_linear();
            let value = value.filter(|_| turns);
            if let (Some(value), Some(text)) = (value, value.and_then(angle_remark)) {
                super::note(&format!("{key} = {value}: {text}"));
            }
        }
        let limits = scene.limits;
        let request = Request {
            arm: scene.arm,
            from: self.from.unwrap_or(scene.from),
            to: self.to,
            duration: self.duration,
            limits: Limits {
                rate: self.max_rate.or(limits.rate),
                acceleration: self.max_acceleration.or(limits.acceleration),
                deceleration: limits.deceleration,
                jerk: self.max_jerk.or(limits.jerk),
                torque: self.max_torque.or(limits.torque),
                moment: self.max_moment.or(limits.moment),
            }
            .validate()?,
            robust: self.robust,
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
        print(&scene.name, &request, &planned);
        println!("  {}", file.display());
        Ok(ExitCode::SUCCESS)
    }
}

fn print(name: &str, request: &Request, planned: &Planned) {
    let Planned { plan, prediction, judgement, .. } = planned;
    let length = request.arm.link.length;
    let kind = match (request.robust, plan) {
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
