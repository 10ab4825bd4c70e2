//! Outcome of the runs with one fault.

/// Counts and greatest values.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Outcome {
    /// Runs.
    pub runs: u64,
    /// Faults put in.
    pub injected: u64,
    /// Setpoints that were judged.
    pub setpoints: u64,
    /// Moves that were refused because the drive's frame does not hold their torque.
    pub refused: u64,
    /// Setpoints whose torque was cut to its frame.
    pub cut: u64,
    /// Stops on the way.
    pub stops: u64,
    /// Greatest way of the setpoints' stop over the brake's own bound.
    pub way: f64,
    /// Greatest angle of the hub behind its setpoint, rad.
    pub behind: f64,
    /// Greatest turn of the hub in the arm's last period, rad.
    pub turn: f64,
    /// Greatest swing of the tip in it, of L.
    pub swing: f64,
    /// Greatest error of the energy balance over work and losses.
    pub energy: f64,
    /// Promises that were broken, with the run's number.
    pub broken: Vec<String>,
}

impl Outcome {
    /// Adds the outcome of other runs.
    pub fn add(&mut self, other: Self) {
        self.runs += other.runs;
        self.injected += other.injected;
        self.setpoints += other.setpoints;
        self.refused += other.refused;
        self.cut += other.cut;
        self.stops += other.stops;
        self.way = self.way.max(other.way);
        self.behind = self.behind.max(other.behind);
        self.turn = self.turn.max(other.turn);
        self.swing = self.swing.max(other.swing);
        self.energy = self.energy.max(other.energy);
        self.broken.extend(other.broken);
    }
}
