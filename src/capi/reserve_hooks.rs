//! What tests ask of the reserves (feature `hooks`).

use super::memory;

/// Blocks that live in reserves.
#[unsafe(no_mangle)]
pub(crate) extern "C" fn fairmesh_test_reserve_blocks() -> u64 {
    memory::live_blocks() as u64
}

/// The largest number of bytes that was taken from reserves at once, and the bytes last set aside.
#[unsafe(no_mangle)]
pub(crate) extern "C" fn fairmesh_test_reserve_peak(aside: &mut u64) -> u64 {
    let (peak, last) = memory::peak();
    *aside = last as u64;
    peak as u64
}
