//! Memory and draws of a machine on a GPU of the host.
//!
//! Textures, targets and depth buffers stay on the GPU between draws. Before a draw, a host copy that is newer is
//! uploaded; a drawn target is downloaded once, when the host reads it.

mod batches;
mod draw;
mod shader;

use super::MachineError;
use crate::exec::gpu::{Board, Gpu, GpuError};
use crate::exec::wgsl::texture;
use crate::output::DepthSurface;
use crate::texture::Image;
use std::collections::BTreeMap;
use std::sync::{Arc, OnceLock};

/// GPU copies of a machine's resources.
#[derive(Debug)]
pub(super) struct Card {
    board: Board,
    textures: BTreeMap<usize, GpuCopy<Image>>,
    depths: BTreeMap<usize, GpuCopy<DepthSurface>>,
}

#[derive(Debug)]
struct GpuCopy<T> {
    base: usize,
    words: usize,
    newer: Newer,
    /// Contents, if they were downloaded since the last draw into the resource.
    back: OnceLock<T>,
}

/// The copy, on the host or on the GPU, that was written last.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Newer {
    /// Both copies are equal.
    Neither,
    Host,
    Device,
}

impl<T> GpuCopy<T> {
    fn new(board: &mut Board, words: usize) -> Result<Self, GpuError> {
        Ok(Self { base: board.allocate(words)?, words, newer: Newer::Host, back: OnceLock::new() })
    }

    /// Uploads the host's copy if it is newer.
    fn send(&mut self, board: &Board, words: impl FnOnce() -> Vec<u32>) -> Result<(), GpuError> {
        if self.newer == Newer::Host {
            board.write(self.base, &words())?;
            self.newer = Newer::Neither;
        }
        Ok(())
    }

    /// Returns the newest contents, given the host's copy.
    fn fetch<'a>(
        &'a self,
        board: &Board,
        host: &'a T,
        made: impl FnOnce(Vec<u32>) -> T,
    ) -> Result<&'a T, MachineError> {
        if self.newer != Newer::Device {
            return Ok(host);
        }
        if let Some(back) = self.back.get() {
            return Ok(back);
        }
        let words = board.read(self.base, self.words)?;
        Ok(self.back.get_or_init(|| made(words)))
    }

    fn drawn_into(&mut self) {
        self.newer = Newer::Device;
        self.back = OnceLock::new();
    }

    fn overwritten(&mut self) {
        self.newer = Newer::Host;
        self.back = OnceLock::new();
    }
}

fn image_of(like: &Image, words: &[u32]) -> Image {
    let mut image = like.clone();
    // The number of words matches by construction, so this cannot fail.
    let _ = texture::words_to_image(words, &mut image);
    image
}

fn surface_of(like: &DepthSurface, words: &[u32]) -> DepthSurface {
    let mut surface = like.clone();
    surface.data_mut().copy_from_slice(words);
    surface
}

impl Card {
    pub(super) fn new(gpu: Arc<Gpu>) -> Result<Self, GpuError> {
        Ok(Self { board: Board::new(gpu)?, textures: BTreeMap::new(), depths: BTreeMap::new() })
    }

    /// Contents of texture `number`, given the host's copy.
    pub(super) fn image<'a>(&'a self, number: usize, host: &'a Image) -> Result<&'a Image, MachineError> {
        match self.textures.get(&number) {
            Some(held) => held.fetch(&self.board, host, |words| image_of(host, &words)),
            None => Ok(host),
        }
    }

    /// Contents of depth buffer `number`, given the host's copy.
    pub(super) fn surface<'a>(
        &'a self,
        number: usize,
        host: &'a DepthSurface,
    ) -> Result<&'a DepthSurface, MachineError> {
        match self.depths.get(&number) {
            Some(held) => held.fetch(&self.board, host, |words| surface_of(host, &words)),
            None => Ok(host),
        }
    }

    pub(super) fn texture_overwritten(&mut self, number: usize) {
        if let Some(held) = self.textures.get_mut(&number) {
            held.overwritten();
        }
    }

    /// Marks a depth buffer as overwritten by the host.
    pub(super) fn depth_overwritten(&mut self, number: usize) {
        if let Some(held) = self.depths.get_mut(&number) {
            held.overwritten();
        }
    }

    /// Frees a texture's GPU copy; returns its contents if it is newer than the host's.
    pub(super) fn release_texture(&mut self, number: usize, host: &Image) -> Result<Option<Image>, MachineError> {
        let Some(held) = self.textures.get(&number) else { return Ok(None) };
        let newest = held.fetch(&self.board, host, |words| image_of(host, &words))?;
        let newest = (held.newer == Newer::Device).then(|| newest.clone());
        let (base, words) = (held.base, held.words);
        self.textures.remove(&number);
        self.board.free(base, words);
        Ok(newest)
    }

    /// Frees a depth buffer's GPU copy; returns its contents if it is newer than the host's.
    pub(super) fn release_depth(
        &mut self,
        number: usize,
        host: &DepthSurface,
    ) -> Result<Option<DepthSurface>, MachineError> {
        let Some(held) = self.depths.get(&number) else { return Ok(None) };
        let newest = held.fetch(&self.board, host, |words| surface_of(host, &words))?;
        let newest = (held.newer == Newer::Device).then(|| newest.clone());
        let (base, words) = (held.base, held.words);
        self.depths.remove(&number);
        self.board.free(base, words);
        Ok(newest)
    }

    /// Ensures that a texture is on the GPU; returns its offset in `video`, in words.
    fn place_texture(&mut self, number: usize, host: &Image) -> Result<usize, GpuError> {
        let held = match self.textures.entry(number) {
            std::collections::btree_map::Entry::Occupied(held) => held.into_mut(),
            std::collections::btree_map::Entry::Vacant(slot) => {
                slot.insert(GpuCopy::new(&mut self.board, texture::image_size(host))?)
            }
        };
        held.send(&self.board, || texture::image_words(host))?;
        Ok(held.base)
    }

    /// Ensures that a depth buffer is on the GPU; returns its offset in `video`, in words.
    fn place_depth(&mut self, number: usize, host: &DepthSurface) -> Result<usize, GpuError> {
        let held = match self.depths.entry(number) {
            std::collections::btree_map::Entry::Occupied(held) => held.into_mut(),
            std::collections::btree_map::Entry::Vacant(slot) => {
                slot.insert(GpuCopy::new(&mut self.board, host.data().len())?)
            }
        };
        held.send(&self.board, || host.data().to_vec())?;
        Ok(held.base)
    }
}
