//! `[state]`: OpenGL's state, which `!!ARBfp1.0` reads as `state.*`. docs/cases.md describes every field.

use std::collections::BTreeMap;

use serde::Deserialize;
use toml::Spanned;

use refsim::{
    exec::{CheckedProgram, FixedFunctionState, LightState},
    isa::ParameterSource,
};

use super::{
    CaseError,
    binder::{Binder, register},
    value::{Exactly, Number, Singles},
};

type FourNumbers = Exactly<Number, 4>;
type FourRows = Exactly<FourNumbers, 4>;
/// Values by the numbers of lights, texture units or program matrices.
type ByNumber<T> = BTreeMap<Spanned<String>, T>;

/// OpenGL's state; everything else has its default.
#[derive(Clone, Debug, Default, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct StateTable {
    material: Option<MaterialTable>,
    back_material: Option<MaterialTable>,
    #[serde(default)]
    light: ByNumber<LightTable>,
    ambient: Option<FourNumbers>,
    #[serde(default)]
    texture_environment: ByNumber<FourNumbers>,
    fog: Option<FogTable>,
    depth_range: Option<Exactly<Number, 2>>,
    modelview: Option<FourRows>,
    projection: Option<FourRows>,
    #[serde(default)]
    texture_matrix: ByNumber<FourRows>,
    #[serde(default)]
    program_matrix: ByNumber<FourRows>,
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
    /// Binds the state of a case; `None`, which is OpenGL's default state, if the case has no state.
    pub(super) fn fixed_function(
        &self,
        table: Option<&Spanned<StateTable>>,
        program: &CheckedProgram,
    ) -> Result<Option<Box<FixedFunctionState>>, CaseError> {
        let Some(table) = table else { return Ok(None) };
        if !program.parameters.iter().any(|p| matches!(p.source, ParameterSource::State(_))) {
            let message =
                "the case has [state], but the pixel program reads no `state.*` and has no fog option".to_owned();
            let help = "remove [state], or use a program that starts with `!!ARBfp1.0` and reads `state.*`";
            return Err(self.place.wrong(table.span(), message, help));
        }
        let table = table.get_ref();
        let mut state = FixedFunctionState::default();
        for (slot, written) in state.materials.iter_mut().zip([&table.material, &table.back_material]) {
            if let Some(written) = written {
                colors(&mut slot.colors, [written.ambient, written.diffuse, written.specular]);
                set(&mut slot.emission, written.emission);
                set(&mut slot.shininess, written.shininess);
            }
        }
        for (number, written) in &table.light {
            let number = self.number(number, state.lights.len())?;
            self.light(&mut state.lights[number], written)?;
        }
        self.by_number(&mut state.texture_environment, &table.texture_environment)?;
        self.by_number(&mut state.texture, &table.texture_matrix)?;
        self.by_number(&mut state.program, &table.program_matrix)?;
        set(&mut state.ambient, table.ambient);
        set(&mut state.modelview, table.modelview);
        set(&mut state.projection, table.projection);
        set(&mut state.depth_range, table.depth_range);
        if let Some(fog) = &table.fog {
            set(&mut state.fog.color, fog.color);
            set(&mut state.fog.density, fog.density);
            set(&mut state.fog.start, fog.start);
            set(&mut state.fog.end, fog.end);
        }
        Ok(Some(Box::new(state)))
    }

    fn by_number<T: Singles>(&self, slots: &mut [T::Bits], written: &ByNumber<T>) -> Result<(), CaseError> {
        for (number, written) in written {
            let number = self.number(number, slots.len())?;
            slots[number] = written.singles();
        }
        Ok(())
    }

    fn number(&self, key: &Spanned<String>, count: usize) -> Result<usize, CaseError> {
        let name = key.get_ref();
        register(&format!("#{name}"), count).ok_or_else(|| {
            let message = format!("expected a number from 0 to {}, found `{name}`", count - 1);
            self.place.wrong(key.span(), message, "lights, texture units and program matrices are numbered from 0")
        })
    }

    fn light(&self, light: &mut LightState, written: &LightTable) -> Result<(), CaseError> {
        colors(&mut light.colors, [written.ambient, written.diffuse, written.specular]);
        set(&mut light.position, written.position);
        set(&mut light.attenuation, written.attenuation);
        set(&mut light.spot_direction, written.spot_direction);
        set(&mut light.spot_exponent, written.spot_exponent);
        if let Some(cutoff) = &written.spot_cutoff {
            let degrees = cutoff.get_ref().double();
            if !(0.0..=90.0).contains(&degrees) && degrees != 180.0 {
                let message = format!("expected a spot cutoff from 0 to 90 degrees, or 180, found {degrees}");
                return Err(self.place.wrong(cutoff.span(), message, "180 means a light that is not a spotlight"));
            }
            light.spot_cutoff = cutoff.get_ref().single();
        }
        Ok(())
    }
}

fn colors(slots: &mut [[u32; 4]; 3], written: [Option<FourNumbers>; 3]) {
    slots.iter_mut().zip(written).for_each(|(slot, written)| set(slot, written));
}

fn set<T: Singles>(slot: &mut T::Bits, written: Option<T>) {
    if let Some(written) = written {
        *slot = written.singles();
    }
}
