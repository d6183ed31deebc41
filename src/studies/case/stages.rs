//! Binding of texture stages: bump state and projections.

use refsim::{
    exec::{BUMP_STAGES, BumpStage, Projection},
    isa::{Opcode, Program},
};
use toml::Spanned;

use super::{CaseError, CaseWarning, binder::Binder, schema, value::Number};

/// Binds the bump state of each stage; Direct3D's initial state is zero.
pub(super) fn bump(
    binder: &Binder<'_>,
    written: &[Spanned<schema::Bump>],
) -> Result<[Option<BumpStage>; BUMP_STAGES], CaseError> {
    let mut stages = [None; BUMP_STAGES];
    for bump in written {
        let (bump, stage) = (bump.get_ref(), &bump.get_ref().stage);
        let wrong = |message, help| Err(binder.place.wrong(stage.span(), message, help));
        match stages.get_mut(*stage.get_ref() as usize) {
            None => {
                let message = format!("expected a stage from 0 to {}, found {}", BUMP_STAGES - 1, stage.get_ref());
                return wrong(message, "the stage is the number of the register that texbem, texbeml or bem writes");
            }
            Some(Some(_)) => {
                return wrong(format!("stage {} is taken", stage.get_ref()), "write one [[bump]] per stage");
            }
            Some(free) => {
                let single = |number: Option<Number>| number.map_or(0, Number::single);
                *free = Some(BumpStage {
                    matrix: bump.matrix.0.map(Number::single),
                    luminance_scale: single(bump.luminance_scale),
                    luminance_offset: single(bump.luminance_offset),
                });
            }
        }
    }
    Ok(stages)
}

/// Sets the projection of the stage that reads a texture.
pub(super) fn project(
    binder: &Binder<'_>,
    projected: &Spanned<Projection>,
    slot: u32,
    pixel: &Program,
    projections: &mut [Projection; BUMP_STAGES],
) -> Result<(), CaseError> {
    if !pixel.version.is_ps_1_1_to_1_3() {
        let message = format!("`projected` is for ps_1_1 to 1_3, but the program is {}", pixel.version);
        let help = "divide in the program: ps_1_4 has _dz and _dw, ps_2_0 has texldp";
        return Err(binder.place.wrong(projected.span(), message, help));
    }
    let Some(stage) = projections.get_mut(slot as usize) else {
        let message = format!("expected a stage from 0 to {}, found slot {slot}", BUMP_STAGES - 1);
        return Err(binder.place.wrong(
            projected.span(),
            message,
            "only a texture in the slot of a stage can be projected",
        ));
    };
    *stage = *projected.get_ref();
    Ok(())
}

/// Warns of stages whose bump state the program reads but the case does not set.
pub(super) fn unset(
    binder: &Binder<'_>,
    shader: &Spanned<schema::ShaderSource>,
    pixel: &Program,
    stages: &[Option<BumpStage>; BUMP_STAGES],
) -> Vec<CaseWarning> {
    let reads = |stage: usize| {
        pixel.instructions.iter().any(|i| {
            matches!(i.opcode, Opcode::Bem | Opcode::TexBem | Opcode::TexBemL)
                && i.destination.is_some_and(|d| usize::from(d.register.index) == stage)
        })
    };
    let unset = (0..BUMP_STAGES).filter(|&stage| stages[stage].is_none() && reads(stage));
    let warning = |stage: usize| {
        let message = format!("the program reads the bump matrix of stage {stage}, which the case does not set");
        let help = format!("Direct3D's state starts with zeros: add [[bump]] with `stage = {stage}` and a `matrix`");
        binder.place.warning(shader.span(), message, help)
    };
    unset.map(warning).collect()
}
