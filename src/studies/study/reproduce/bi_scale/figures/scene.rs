//! Models with bidirectional textures, for pictures by transfer and by rays.

use glam::DVec3;

use super::super::models::ModelVisibility;
use super::{HOST, ModelSize, StudyError, failed};
use crate::bi_scale::bicluster::{BiclusterOptions, bicluster};
use crate::bi_scale::directions::LocalDirections;
use crate::bi_scale::file::{BiScaleFile, BiScaleMeaning};
use crate::bi_scale::texture::{PatchKind, TextureSampling};
use crate::geom::vector::wide;
use crate::scene::Camera;
use crate::scene::built::flat_models::MaterialMesh;
use crate::study::framing::framed;
use crate::study::prt::{BiScaleRendering, LitView, SurfaceTexture, TexturedSurface};
use crate::study::reproduce::sky::HARD_SUN;
use crate::transfer::file::MeshDigest;
use crate::transfer::light::DistantLight;
use crate::transfer::visibility::Horizon;

/// Samples along an edge of a pixel of [`FigureSize::shown`].
pub(super) const SAMPLES: u32 = 2;

/// Sizes of models, pictures and textures.
#[derive(Clone, Copy, Debug)]
pub(super) struct FigureSize {
    /// Edge length of models, relative to the paper's.
    pub(super) coarser: u32,
    /// Size of the pictures that are compared with those by rays, in pixels.
    pub(super) picture: [u32; 2],
    /// Size of pictures by transfer alone, in pixels, with [`SAMPLES`] along an edge of each.
    pub(super) shown: [u32; 2],
    /// Texels along an edge of patches: of fine ones, and of others.
    pub(super) texels: [usize; 2],
    /// View directions along an edge.
    pub(super) views: usize,
    /// Repetitions of a patch per unit of texture coordinates, so that it is visible at this picture size.
    pub(super) repeat: f64,
}

impl FigureSize {
    pub(super) fn of(models: ModelSize) -> Self {
        match models {
            ModelSize::Reduced => {
                Self { coarser: 3, picture: [40, 30], shown: [320, 240], texels: [16, 8], views: 12, repeat: 2.0 }
            }
            ModelSize::Printed => {
                Self { coarser: 1, picture: [160, 120], shown: [640, 480], texels: [64, 32], views: 12, repeat: 5.0 }
            }
        }
    }

    /// Size for figures on which no row depends: reduced, a quarter of the pixels and coarser models.
    pub(super) fn of_pictures(models: ModelSize) -> Self {
        let size = Self::of(models);
        match models {
            ModelSize::Reduced => Self { coarser: 5, picture: [20, 15], ..size },
            ModelSize::Printed => size,
        }
    }
}

/// Model to draw.
pub(super) struct TexturedModel {
    pub(super) name: &'static str,
    pub(super) model: MaterialMesh,
    /// Patch of each material, and its index into [`FigureSize::texels`].
    pub(super) patches: Vec<(PatchKind, usize)>,
    /// Position of the eye, in units of the model's size, relative to its center.
    pub(super) eye: DVec3,
}

impl TexturedModel {
    /// Computes the transfer to `side` local directions along an edge as biclusters, textures and a camera, under a
    /// clear sky with a sun.
    pub(super) fn rendering(&self, side: usize, size: FigureSize) -> Result<BiScaleRendering, StudyError> {
        let fail = failed(HOST);
        let MaterialMesh { mesh, material_of, .. } = &self.model;
        let seen = ModelVisibility::new(mesh, Horizon::Normal)?;
        let matrix = seen.matrix(side)?;
        let biclusters = bicluster(&matrix, BiclusterOptions::default(), &mut |_| ()).map_err(|e| fail(&e))?;
        let meaning =
            BiScaleMeaning { mesh: MeshDigest::new(&seen.vertices), side: side as u32, horizon: Horizon::Normal };
        let file = BiScaleFile { meaning: Some(meaning), matrix: Some(matrix), biclusters: Some(biclusters) };
        let camera = self.camera(size.picture)?;
        let surface = TexturedSurface::new(mesh.clone(), seen.vertices, material_of.clone(), size.repeat);
        Ok(BiScaleRendering {
            view: LitView {
                model: self.name.to_owned(),
                light: "a clear sky with a sun".to_owned(),
                camera,
                exposure: None,
            },
            surface: surface.map_err(|e| fail(&e))?,
            file,
            textures: self.textures(side, size)?,
            light: DistantLight::Sky(HARD_SUN),
            reference: true,
        })
    }

    fn textures(&self, side: usize, size: FigureSize) -> Result<Vec<SurfaceTexture>, StudyError> {
        let fail = failed(HOST);
        let directions = |side| LocalDirections::new(side).map_err(|e| fail(&e));
        let texture = |&(kind, texels): &(PatchKind, usize)| {
            let (view, light) = (directions(size.views)?, directions(side)?);
            let sampling = TextureSampling { size: size.texels[texels], view, light, samples: 1 };
            let patch = kind.patch(1.0);
            let samples = patch.texture(&sampling, &mut |_, _| ()).map_err(|e| fail(&e))?;
            Ok(SurfaceTexture { name: kind.to_string(), samples, patch: Some(patch) })
        };
        self.patches.iter().map(texture).collect()
    }

    /// Camera of a picture that the model fills; `size` in pixels, or samples.
    pub(super) fn camera(&self, [width, height]: [u32; 2]) -> Result<Camera, StudyError> {
        let [low, high] = self.model.mesh.bounds().unwrap_or_default().map(wide);
        let (middle, size) = ((low + high) / 2.0, (high - low).max_element());
        let points: Vec<DVec3> = self.model.mesh.positions().iter().map(|&at| wide(at)).collect();
        let view = framed(middle + size * self.eye, &points, f64::from(width) / f64::from(height));
        view.camera(width, height).map_err(|e| failed(HOST)(&e))
    }
}
