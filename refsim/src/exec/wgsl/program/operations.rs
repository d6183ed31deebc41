//! Operations of the machine; below 32 `vm.wgsl: shade`, the others `vm_flow`.

pub(super) const END: u32 = 0;
pub(super) const ALU: u32 = 1;
pub(super) const BITWISE: u32 = 2;
pub(super) const DOT: u32 = 3;
pub(super) const RELATIVE: u32 = 6;
pub(super) const FETCH: u32 = 7;
pub(super) const COLOR: u32 = 8;
pub(super) const KILLED: u32 = 9;
pub(super) const DEPTH: u32 = 10;
pub(super) const FETCHED: u32 = 11;
pub(super) const STEP: u32 = 12;
pub(super) const ZERO: u32 = 13;
pub(super) const TRACE: u32 = 14;
pub(super) const OUTPUT: u32 = 15;
pub(super) const IF: u32 = 32;
pub(super) const ELSE: u32 = 33;
pub(super) const END_IF: u32 = 34;
pub(super) const LOOP: u32 = 35;
pub(super) const END_LOOP: u32 = 36;
pub(super) const BREAK: u32 = 37;
pub(super) const CALL: u32 = 38;
pub(super) const RET: u32 = 39;
pub(super) const LABEL: u32 = 40;
// Variants of `BITWISE`.
pub(super) const COPY: u32 = 0;
pub(super) const AND: u32 = 1;
pub(super) const OR: u32 = 2;
pub(super) const AND_NOT: u32 = 3;
pub(super) const SELECT: u32 = 4;
