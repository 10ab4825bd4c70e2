//! The serial line to the host: one writer for the answers and the setpoints.

use embassy_futures::select::{Either, select};
use embassy_sync::blocking_mutex::raw::CriticalSectionRawMutex;
use embassy_sync::mutex::Mutex;
use embedded_io_async::Write;
use stillbeam_protocol::{Report, frame};
use stillbeam_wiring::Recording;
use stillbeam_wiring::drive::Setpoint;

use crate::board::LinkWriter;
use crate::record::ROWS;
use crate::tick::TO_HOST;

/// Whoever holds it sends a whole frame.
pub static LINK: Mutex<CriticalSectionRawMutex, Option<Link>> = Mutex::new(None);

/// The line and the frame being sent.
pub struct Link {
    writer: LinkWriter,
    frame: [u8; frame::MAX],
}

/// Opens the line.
pub async fn open(writer: LinkWriter) {
    *LINK.lock().await = Some(Link { writer, frame: [0; frame::MAX] });
}

/// Sends one report.
pub async fn send(report: &Report<'_>) {
    if let Some(link) = LINK.lock().await.as_mut() {
        // Every report fits a frame; a line that fails is as good as a host that is gone.
        if let Ok(bytes) = frame::encode(report, &mut link.frame) {
            let _ = link.writer.write_all(bytes).await;
        }
    }
}

/// Sends every setpoint and every row of a recording. Where the line is too slow for both the
/// setpoints go first, because the host follows the axes by them.
#[embassy_executor::task]
pub async fn setpoints() {
    loop {
        let report = match select(TO_HOST.receive(), ROWS.receive()).await {
            Either::First(Setpoint { axis, tick, cause }) => Report::Tick { axis, tick, cause },
            Either::Second((axis, row)) => match row {
                Recording::Row(sample) => Report::Sample { axis, sample },
                Recording::End { sequence, samples, lost } => {
                    Report::Recorded { sequence, samples, lost }
                }
            },
        };
        send(&report).await;
    }
}
