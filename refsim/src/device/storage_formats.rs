//! Number formats of the values that pixel programs store.

use super::instruction_formats::MAX_INSTRUCTION_FORMATS;
use crate::isa::{Instruction, Program, RegisterFile, ResultKind};
use crate::num::Format;

/// A storage of numbers that can have its own format. Numbers stay in the register format, but are rounded to the
/// storage's format when written. docs/devices.md has the table.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum Storage {
    /// Temporaries `r#`, `R#`, `H#`, and `t#` where instructions write it (ps_1_1 to 1_3). Packed words are not
    /// rounded.
    Temporaries,
    /// Float constants.
    Constants,
    /// Results of texture reads.
    Texels,
    /// Interpolated colors, after their clamp and the iterator's precision.
    Colors,
    /// Interpolated texture coordinates, for arithmetic and for addresses: single-precision values rounded to the
    /// format.
    Coordinates,
    /// Output colors, before tests and blending. Depth has no format.
    Outputs,
}

impl Storage {
    /// Every storage.
    pub const ALL: [Self; 6] =
        [Self::Temporaries, Self::Constants, Self::Texels, Self::Colors, Self::Coordinates, Self::Outputs];

    /// The name in device files.
    pub const fn name(self) -> &'static str {
        match self {
            Self::Temporaries => "temporaries",
            Self::Constants => "constants",
            Self::Texels => "texels",
            Self::Colors => "colors",
            Self::Coordinates => "coordinates",
            Self::Outputs => "outputs",
        }
    }

    /// Returns `true` if an instruction of a pixel program reads or writes the storage. Every program has outputs.
    fn is_used_by(self, instruction: &Instruction) -> bool {
        let reads = |file| instruction.sources.iter().any(|source| source.register.file == file);
        let file = instruction.destination.map(|destination| destination.register.file);
        let result = instruction.opcode.info().result;
        match self {
            Self::Temporaries => file.and_then(Self::written) == Some(Self::Temporaries) && result != ResultKind::None,
            Self::Constants => reads(RegisterFile::Constant),
            Self::Texels => result == ResultKind::Texel,
            Self::Colors => reads(RegisterFile::Input),
            Self::Coordinates => reads(RegisterFile::Texture) || file == Some(RegisterFile::Texture),
            Self::Outputs => true,
        }
    }

    /// The storage that an instruction of a pixel program writes to; `None` for register files without a storage.
    pub(crate) const fn written(file: RegisterFile) -> Option<Self> {
        match file {
            RegisterFile::Temp | RegisterFile::Half | RegisterFile::Texture => Some(Self::Temporaries),
            RegisterFile::ColorOut | RegisterFile::HalfColorOut => Some(Self::Outputs),
            _ => None,
        }
    }
}

/// Number formats of storages of pixel programs; a storage without a format holds every number of the register format.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct StorageFormats([Option<Format>; Storage::ALL.len()]);

impl StorageFormats {
    /// Format of a storage.
    pub const fn of(&self, storage: Storage) -> Option<Format> {
        self.0[storage as usize]
    }

    /// Storages that have a format.
    pub fn iter(&self) -> impl Iterator<Item = (Storage, Format)> {
        let formats = self.0;
        Storage::ALL.into_iter().filter_map(move |storage| Some((storage, formats[storage as usize]?)))
    }

    /// Format of the numbers that an instruction of a pixel program writes to a register file.
    pub(crate) fn written(&self, file: RegisterFile) -> Option<Format> {
        self.of(Storage::written(file)?)
    }

    /// Storages with a format that a pixel program never uses.
    pub fn unused(&self, program: &Program) -> Vec<Storage> {
        let uses = |storage: Storage| program.instructions.iter().any(|instruction| storage.is_used_by(instruction));
        self.iter().map(|(storage, _)| storage).filter(|&storage| !uses(storage)).collect()
    }

    pub(super) fn set(&mut self, storage: Storage, format: Option<Format>) {
        self.0[storage as usize] = format;
    }
}

/// Largest number of formats that a program can add to the formats of every program: formats of instructions, storages,
/// sums and products.
pub(crate) const MAX_PROGRAM_FORMATS: usize = MAX_INSTRUCTION_FORMATS + Storage::ALL.len() + 2;
