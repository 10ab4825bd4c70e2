//! From a setpoint of the hub to the bytes of a drive, behind gear, friction and rotor.

use stillbeam::drive::{Encoded, cia402, moteus, odrive};
use stillbeam::motor::{Demand, Direction, Drivetrain, Joint, Ratio};
use stillbeam::{Angle, Error, axis};

use crate::Status;
use crate::fault::Fault;
use crate::memory::{Versioned, check, give, structure, versioned};
use crate::object::{self, Object, bytes_of};
use crate::tick::{Mode, Setpoint};

/// Words of 8 bytes in `sb_drive`.
pub const SB_DRIVE_WORDS: usize = 20;

/// Storage of a drive.
#[repr(C)]
#[derive(Debug)]
pub struct Drive {
    words: [u64; SB_DRIVE_WORDS],
}

/// Gear and motor of an arm, and what its drive is told. `abi` must be given. A field that is 0 is
/// not there: a lossless direct drive without friction is all zeros.
#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct Gear {
    /// `SB_ABI`.
    pub abi: u32,
    /// Turns of the motor, to 65535 ...
    pub motor_turns: u32,
    /// ... in so many turns of the hub, to 65535; 0 in both is 1 : 1.
    pub hub_turns: u32,
    /// Efficiency of the gear, 0.01 to 1; 0 is lossless.
    pub efficiency: f64,
    /// Inertia of rotor and input shaft about the motor's axis, kg m^2.
    pub rotor_inertia: f64,
    /// Coulomb friction at the hub, N m.
    pub coulomb: f64,
    /// Viscous friction at the hub, N m s/rad.
    pub viscous: f64,
    /// Angle of the motor's shaft where the hub's is 0, turns.
    pub zero: f64,
    /// moteus: time without a setpoint after which the drive stops by itself, s; 0.001 to 10.
    pub watchdog: f64,
    /// CiA 402: rated torque of the motor, object 0x6076, N m.
    pub rated_torque: f64,
    /// CiA 402: increments of the encoder in a turn of the motor, 4 to 2^24.
    pub increments: u32,
    /// 1 if the motor turns against the hub.
    pub opposite: u32,
    /// Not used; 0.
    pub reserved: u32,
}

// SAFETY: `repr(C)`, `abi` is first, and all fields are numbers.
unsafe impl Versioned for Gear {
    const NAME: &'static str = "gear";
}

/// A drive as it lies in the storage.
pub(crate) struct Encoder {
    train: Drivetrain<f32>,
    watchdog: f64,
    rated_torque: f64,
    increments: u32,
}

impl Object for Encoder {
    const NAME: &'static str = "drive";
    const MAGIC: u32 = u32::from_le_bytes(*b"SBdr");
    type Storage = Drive;
}

const _: () = assert!(bytes_of::<Encoder>() <= size_of::<Drive>());

/// A node's number, which the payload does not hold.
const ANY_NODE: u8 = 1;

/// Greatest angle of a shaft either way, turns: a frame's f32 tells turns apart up to here.
const MAX_TURNS: f64 = 2_097_151.0;

impl Gear {
    fn encoder(&self) -> Result<Encoder, Fault> {
        let joint = Joint {
            ratio: Ratio {
                motor: turns("gear.motor_turns", self.motor_turns)?,
                link: turns("gear.hub_turns", self.hub_turns)?,
            },
            efficiency: if self.efficiency == 0.0 { 1.0 } else { self.efficiency },
            rotor_inertia: self.rotor_inertia,
            coulomb: self.coulomb,
            viscous: self.viscous,
            // Of the motor's current, which no protocol here carries.
            torque_constant: 1.0,
        };
        let direction = if self.opposite == 0 { Direction::Same } else { Direction::Opposite };
        Ok(Encoder {
            train: Drivetrain::new(&joint, direction, self.zero)?,
            watchdog: self.watchdog,
            rated_torque: self.rated_torque,
            increments: self.increments,
        })
    }
}

/// Returns turns of a gear's ratio; 0 is 1.
fn turns(name: &'static str, turns: u32) -> Result<u16, Fault> {
    let range = (1.0, f64::from(u16::MAX));
    Ok(Fault::check(name, f64::from(turns.max(1)), range, "turns")? as u16)
}

/// Initialises a drive.
///
/// # Safety
/// `drive` is NULL or points to `bytes` bytes that nothing else uses during the call. `gear` is
/// NULL or points to a structure of the version that its first field names.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn sb_drive_init(
    drive: *mut Drive,
    bytes: usize,
    gear: *const Gear,
) -> Status {
    // SAFETY: the caller's promise.
    unsafe { object::init::<Encoder>(drive, bytes, || versioned(gear)?.encoder()) }
}

/// Writes the hub angle, rad, at which the motor's shaft is at `shaft` turns, as its encoder counts
/// them: what `sb_enable` is to be given.
///
/// # Safety
/// `drive` is NULL or points to storage of a drive that no other call uses; `angle` is NULL or can
/// be written.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn sb_hub_angle(drive: *mut Drive, shaft: f64, angle: *mut f64) -> Status {
    // SAFETY: the caller's promise.
    unsafe {
        object::with::<Encoder>(drive, |drive| {
            let range = (-MAX_TURNS, MAX_TURNS);
            let shaft = Fault::check("shaft", shaft, range, "turns")?;
            let shaft = Angle { turns: 0, part: 0.0 }.plus(shaft).cast();
            give(angle, (*drive).train.mapping().to_link(shaft).radians());
            Ok(())
        })
    }
}

/// Writes a setpoint as the 8 bytes of ODrive's Set_Input_Pos, whose CAN identifier is
/// `node << 5 | 0x0c`. A setpoint of a disabled axis is refused, as it is not to be sent. May be
/// called in the interrupt.
///
/// # Safety
/// As of `sb_hub_angle`; `setpoint` is NULL or points to a setpoint, `payload` is NULL or 8 bytes
/// can be written.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn sb_odrive(
    drive: *mut Drive,
    setpoint: *const Setpoint,
    payload: *mut u8,
) -> Status {
    // SAFETY: the caller's promise.
    unsafe { encode(drive, setpoint, payload, |_, demand| Ok(odrive::encode(demand))) }
}

/// Writes a setpoint as the 24 bytes of a moteus frame, CAN FD, to the servo's own identifier. The
/// drive stops by itself after `sb_gear.watchdog`, which must be given. Else as `sb_odrive`.
///
/// # Safety
/// As of `sb_odrive`, with 24 bytes.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn sb_moteus(
    drive: *mut Drive,
    setpoint: *const Setpoint,
    payload: *mut u8,
) -> Status {
    let encode_one = |encoder: &Encoder, demand: &Demand<f32>| {
        Ok(moteus::Servo::new(ANY_NODE, encoder.watchdog)?.encode(demand))
    };
    // SAFETY: the caller's promise.
    unsafe { encode(drive, setpoint, payload, encode_one) }
}

/// Writes a setpoint as the 10 bytes of CiA 402's cyclic synchronous position: objects 0x607A,
/// 0x60B1, 0x60B2. `sb_gear.increments` and `sb_gear.rated_torque` must be given. Else as
/// `sb_odrive`.
///
/// # Safety
/// As of `sb_odrive`, with 10 bytes.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn sb_cia402(
    drive: *mut Drive,
    setpoint: *const Setpoint,
    payload: *mut u8,
) -> Status {
    let encode_one = |encoder: &Encoder, demand: &Demand<f32>| {
        let (increments, rated_torque) = (encoder.increments, encoder.rated_torque);
        Ok(cia402::Drive::new(ANY_NODE, increments, rated_torque)?.encode(demand))
    };
    // SAFETY: the caller's promise.
    unsafe { encode(drive, setpoint, payload, encode_one) }
}

/// Encodes a setpoint, and tells what did not fit the format.
///
/// # Safety
/// As of `sb_odrive`, with `N` bytes.
unsafe fn encode<const N: usize>(
    drive: *mut Drive,
    setpoint: *const Setpoint,
    payload: *mut u8,
    encode_one: impl FnOnce(&Encoder, &Demand<f32>) -> Result<Option<Encoded<[u8; N]>>, Error>,
) -> Status {
    // SAFETY: the caller's promise.
    unsafe {
        object::with::<Encoder>(drive, |drive| {
            let setpoint = structure("setpoint", setpoint)?;
            check("payload", payload)?;
            let encoder = &*drive;
            if setpoint.mode == Mode::Disabled as i32 {
                return Err(Error::WrongMode { mode: axis::Mode::Disabled }.into());
            }
            let demand = encoder.train.demand(&setpoint.core());
            let encoded = encode_one(encoder, &demand)?.ok_or(Fault::NotFinite)?;
            payload.cast::<[u8; N]>().write(encoded.payload);
            let cut = encoded.saturated;
            if cut.any() { Err(Fault::Saturated(cut)) } else { Ok(()) }
        })
    }
}
