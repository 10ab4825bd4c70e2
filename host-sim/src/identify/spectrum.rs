//! Amplitude spectra of samples at uneven times, for starting values and pictures.

use rustfft::FftPlanner;
use rustfft::num_complex::Complex;

/// Number of points to which a record is filled up with zeros, in its own length.
const PADDING: usize = 4;

/// Amplitudes over frequency.
#[derive(Clone, Debug)]
pub struct Spectrum {
    /// Distance of the frequencies from each other, Hz. The first is 0.
    pub spacing: f64,
    /// Amplitudes of sines that do not decay, in the units of the samples.
    pub amplitude: Vec<f64>,
    /// Length of the record, s.
    length: f64,
}

/// A maximum of a spectrum.
#[derive(Clone, Copy, Debug)]
pub struct Peak {
    /// Frequency, Hz.
    pub frequency: f64,
    /// Amplitude.
    pub amplitude: f64,
    /// Amplitude over the median of those around it.
    pub prominence: f64,
}

impl Spectrum {
    /// Computes the spectrum of samples, which are interpolated at their mean interval and faded
    /// out towards the end of the record. Fading in would hide what decays fast.
    pub fn of(time: &[f64], value: &[f64]) -> Self {
        let count = time.len();
        let length = time[count - 1] - time[0];
        let interval = length / (count - 1) as f64;
        let mean = value.iter().sum::<f64>() / count as f64;
        let mut k = 0;
        let mut points: Vec<Complex<f64>> = (0..count)
            .map(|n| {
                let t = time[0] + n as f64 * interval;
                while k + 2 < count && time[k + 1] < t {
                    k += 1;
                }
                let share = ((t - time[k]) / (time[k + 1] - time[k])).clamp(0.0, 1.0);
                let x = value[k] + share * (value[k + 1] - value[k]) - mean;
                let fade = 0.5 + 0.5 * (std::f64::consts::PI * n as f64 / count as f64).cos();
                Complex::new(fade * x, 0.0)
            })
            .collect();
        let padded = (PADDING * count).next_power_of_two();
        points.resize(padded, Complex::default());
        FftPlanner::new().plan_fft_forward(padded).process(&mut points);
        // The mean of the fading is a half.
        let scale = 4.0 / count as f64;
        let amplitude = points[..padded / 2].iter().map(|x| scale * x.norm()).collect();
        Self { spacing: 1.0 / (padded as f64 * interval), amplitude, length }
    }

    /// Returns the highest maximum between two frequencies at which `admits` is true.
    pub fn peak(&self, low: f64, high: f64, admits: &dyn Fn(f64) -> bool) -> Option<Peak> {
        let (first, last) = (self.index(low).max(1), self.index(high));
        let a = &self.amplitude;
        let after = |k: usize| a.get(k + 1).copied().unwrap_or(0.0);
        let maxima = (first..(last + 1).min(a.len()))
            .filter(|&k| a[k] >= a[k - 1] && a[k] > after(k))
            .filter(|&k| admits(k as f64 * self.spacing));
        let best = maxima.max_by(|&i, &k| a[i].total_cmp(&a[k]))?;
        let frequency = best as f64 * self.spacing;
        Some(Peak { frequency, amplitude: a[best], prominence: a[best] / self.floor(best) })
    }

    /// Returns the median of the amplitudes around a maximum, its own slopes left out.
    fn floor(&self, peak: usize) -> f64 {
        let own = (4.0 / self.length / self.spacing) as usize;
        let reach = (peak * 2 / 5).max(12 * own);
        let around = |range: std::ops::Range<usize>| {
            let end = range.end.min(self.amplitude.len());
            self.amplitude[range.start.min(end)..end].iter().copied()
        };
        let below = around(peak.saturating_sub(reach).max(own)..peak.saturating_sub(own));
        let mut values: Vec<f64> = below.chain(around(peak + own..peak + reach)).collect();
        if values.is_empty() {
            return f64::MIN_POSITIVE;
        }
        values.sort_by(f64::total_cmp);
        values[values.len() / 2].max(f64::MIN_POSITIVE)
    }

    fn index(&self, frequency: f64) -> usize {
        (frequency / self.spacing).round().max(0.0) as usize
    }
}
