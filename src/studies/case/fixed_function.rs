//! `[state]`: OpenGL's state, which `!!ARBfp1.0` reads as `state.*`.

use std::{collections::BTreeMap, ops::Range};

use serde::Deserialize;
use toml::Spanned;

use refsim::{
    exec::{CheckedProgram, FixedFunctionState, FogState, LightState, MaterialState, MatrixRows},
    isa::ParameterSource,
};

use super::{
    CaseError,
    binder::{Binder, register},
    value::{Exactly, Number},
};

type FourNumbers = Exactly<Number, 4>;
type FourRows = Exactly<FourNumbers, 4>;

/// OpenGL's state; everything else has its default.
#[derive(Clone, Debug, Default, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct StateTable {
    /// Front material.
    material: Option<MaterialTable>,
    back_material: Option<MaterialTable>,
    /// Lights, by number.
    #[serde(default)]
    light: BTreeMap<Spanned<String>, LightTable>,
    /// Ambient light of the scene.
    ambient: Option<FourNumbers>,
    /// Environment colors of texture units, by number.
    #[serde(default)]
    texture_environment: BTreeMap<Spanned<String>, FourNumbers>,
    fog: Option<FogTable>,
    /// Window depth of the near and the far plane.
    depth_range: Option<Exactly<Number, 2>>,
    modelview: Option<FourRows>,
    projection: Option<FourRows>,
    /// Matrices of texture units, by number.
    #[serde(default)]
    texture_matrix: BTreeMap<Spanned<String>, FourRows>,
    /// Program matrices of the application, by number.
    #[serde(default)]
    program_matrix: BTreeMap<Spanned<String>, FourRows>,
}

#[derive(Clone, Debug, Deserialize)]
#[serde(deny_unknown_fields)]
struct MaterialTable {
    ambient: Option<FourNumbers>,
    diffuse: Option<FourNumbers>,
    specular: Option<FourNumbers>,
    emission: Option<FourNumbers>,
    shininess: Option<Number>,
}

#[derive(Clone, Debug, Deserialize)]
#[serde(deny_unknown_fields)]
struct LightTable {
    ambient: Option<FourNumbers>,
    diffuse: Option<FourNumbers>,
    specular: Option<FourNumbers>,
    position: Option<FourNumbers>,
    attenuation: Option<Exactly<Number, 3>>,
    spot_direction: Option<Exactly<Number, 3>>,
    spot_exponent: Option<Number>,
    spot_cutoff: Option<Spanned<Number>>,
}

#[derive(Clone, Debug, Deserialize)]
#[serde(deny_unknown_fields)]
struct FogTable {
    color: Option<FourNumbers>,
    density: Option<Number>,
    start: Option<Number>,
    end: Option<Number>,
}

impl Binder<'_> {
    /// Binds the state of a case; `None`, which is OpenGL's default state, if the case has none.
    pub(super) fn fixed_function(
        &self,
        table: Option<&Spanned<StateTable>>,
        program: &CheckedProgram,
    ) -> Result<Option<Box<FixedFunctionState>>, CaseError> {
        let Some(table) = table else { return Ok(None) };
        if !program.parameters.iter().any(|p| matches!(p.source, ParameterSource::State(_))) {
            let message = "[state], but the pixel program reads no `state.*` and has no fog option".to_owned();
            let help = "leave it out, or read it in a program that starts with `!!ARBfp1.0`";
            return Err(self.place.wrong(table.span(), message, help));
        }
        let table = table.get_ref();
        let mut state = FixedFunctionState::default();
        for (slot, written) in state.materials.iter_mut().zip([&table.material, &table.back_material]) {
            if let Some(written) = written {
                material(slot, written);
            }
        }
        for (number, written) in &table.light {
            let number = self.number(number, state.lights.len())?;
            self.light(&mut state.lights[number], written)?;
        }
        self.by_number(&mut state.texture_environment, &table.texture_environment, vector)?;
        self.by_number(&mut state.texture, &table.texture_matrix, matrix)?;
        self.by_number(&mut state.program, &table.program_matrix, matrix)?;
        set(&mut state.ambient, table.ambient.as_ref(), vector);
        set(&mut state.modelview, table.modelview.as_ref(), matrix);
        set(&mut state.projection, table.projection.as_ref(), matrix);
        set(&mut state.depth_range, table.depth_range.as_ref(), |written| written.0.map(Number::single));
        if let Some(written) = &table.fog {
            fog(&mut state.fog, written);
        }
        Ok(Some(Box::new(state)))
    }

    fn by_number<S, T>(
        &self,
        slots: &mut [S],
        written: &BTreeMap<Spanned<String>, T>,
        value: fn(&T) -> S,
    ) -> Result<(), CaseError> {
        for (number, written) in written {
            let number = self.number(number, slots.len())?;
            slots[number] = value(written);
        }
        Ok(())
    }

    fn number(&self, key: &Spanned<String>, count: usize) -> Result<usize, CaseError> {
        let name = key.get_ref();
        register(&format!("#{name}"), count).ok_or_else(|| {
            let message = format!("expected a number from 0 to {}, found `{name}`", count - 1);
            self.place.wrong(key.span(), message, "lights, texture units and program matrices are numbered")
        })
    }

    fn light(&self, light: &mut LightState, written: &LightTable) -> Result<(), CaseError> {
        colors(&mut light.colors, [&written.ambient, &written.diffuse, &written.specular]);
        set(&mut light.position, written.position.as_ref(), vector);
        set(&mut light.attenuation, written.attenuation.as_ref(), |three| three.0.map(Number::single));
        set(&mut light.spot_direction, written.spot_direction.as_ref(), |three| three.0.map(Number::single));
        set(&mut light.spot_exponent, written.spot_exponent.as_ref(), |n| n.single());
        if let Some(cutoff) = &written.spot_cutoff {
            light.spot_cutoff = self.cutoff(*cutoff.get_ref(), cutoff.span())?;
        }
        Ok(())
    }

    fn cutoff(&self, cutoff: Number, span: Range<usize>) -> Result<u32, CaseError> {
        let degrees = cutoff.double();
        if (0.0..=90.0).contains(&degrees) || degrees == 180.0 {
            return Ok(cutoff.single());
        }
        let message = format!("expected a spot cutoff from 0 to 90 degrees, or 180, found {degrees}");
        Err(self.place.wrong(span, message, "180 is a light without a spot"))
    }
}

fn material(material: &mut MaterialState, written: &MaterialTable) {
    colors(&mut material.colors, [&written.ambient, &written.diffuse, &written.specular]);
    set(&mut material.emission, written.emission.as_ref(), vector);
    set(&mut material.shininess, written.shininess.as_ref(), |n| n.single());
}

fn fog(fog: &mut FogState, written: &FogTable) {
    set(&mut fog.color, written.color.as_ref(), vector);
    set(&mut fog.density, written.density.as_ref(), |n| n.single());
    set(&mut fog.start, written.start.as_ref(), |n| n.single());
    set(&mut fog.end, written.end.as_ref(), |n| n.single());
}

fn colors(slots: &mut [[u32; 4]; 3], written: [&Option<FourNumbers>; 3]) {
    for (slot, written) in slots.iter_mut().zip(written) {
        set(slot, written.as_ref(), vector);
    }
}

fn set<S, T>(slot: &mut S, written: Option<&T>, value: impl Fn(&T) -> S) {
    if let Some(written) = written {
        *slot = value(written);
    }
}

fn vector(written: &FourNumbers) -> [u32; 4] {
    written.0.map(Number::single)
}

fn matrix(written: &FourRows) -> MatrixRows {
    written.0.map(|row| vector(&row))
}
