//! A classic CAN frame for those who have no other: a captured stream, a test, a host.

use embedded_can::{Frame, Id};

/// A classic data frame, up to 8 bytes.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct ClassicFrame {
    id: Id,
    data: [u8; 8],
    length: u8,
    remote: bool,
}

impl Frame for ClassicFrame {
    fn new(id: impl Into<Id>, data: &[u8]) -> Option<Self> {
        let mut bytes = [0; 8];
        bytes.get_mut(..data.len())?.copy_from_slice(data);
        Some(Self { id: id.into(), data: bytes, length: data.len() as u8, remote: false })
    }

    fn new_remote(id: impl Into<Id>, dlc: usize) -> Option<Self> {
        (dlc <= 8).then(|| Self { id: id.into(), data: [0; 8], length: dlc as u8, remote: true })
    }

    fn is_extended(&self) -> bool {
        matches!(self.id, Id::Extended(_))
    }

    fn is_remote_frame(&self) -> bool {
        self.remote
    }

    fn id(&self) -> Id {
        self.id
    }

    fn dlc(&self) -> usize {
        self.length.into()
    }

    fn data(&self) -> &[u8] {
        if self.remote { &[] } else { &self.data[..usize::from(self.length.min(8))] }
    }
}

/// The identifier `id` if it has 11 bits; those that are built here all have.
pub(super) fn standard(id: u16) -> embedded_can::StandardId {
    embedded_can::StandardId::new(id & 0x7ff).unwrap_or(embedded_can::StandardId::MAX)
}
