//! Parser of `state.*` in `!!ARBfp1.0` (GL_ARB_fragment_program, grammar from `<stateSingleItem>` and
//! `<stateMultipleItem>` on).

use super::super::error::{Parsed, SyntaxError};
use super::arb::{Parser, unknown};
use super::operand;
use crate::asm::lexer::Token;
use crate::isa::{
    LightingColor, MAX_LIGHTS, MAX_PROGRAM_MATRICES, MAX_TEXTURE_UNITS, MaterialFace, MatrixForm, StateBinding,
    StateMatrix,
};

const HELP: &str = "write for example state.light[0].position, state.fog.color or state.matrix.mvp.row[0]";

impl<'a> Parser<'a> {
    /// Parses one item of state, which has four numbers.
    pub(super) fn state_item(&mut self) -> Parsed<StateBinding> {
        let start = self.cursor.peek();
        let mut rows = self.state_items(false)?;
        match (rows.pop(), rows.pop()) {
            (Some(one), None) => Ok(one),
            _ => Err(unknown(start, "one row of a matrix", "write `.row[0]`; a whole matrix needs an array")),
        }
    }

    /// Parses the state of array elements: a single item, several rows of a matrix, or all four rows.
    pub(super) fn state_items(&mut self, many: bool) -> Parsed<Vec<StateBinding>> {
        self.cursor.next();
        let group = self.part()?;
        let one = match group.text {
            "material" => self.material()?,
            "light" => self.light()?,
            "lightmodel" => self.light_model()?,
            "lightprod" => self.light_product()?,
            "texenv" => {
                let unit = self.optional_number(MAX_TEXTURE_UNITS)?;
                self.word("color")?;
                StateBinding::TextureEnvironment(unit)
            }
            "fog" => {
                let token = self.part()?;
                match token.text {
                    "color" => StateBinding::FogColor,
                    "params" => StateBinding::FogParams,
                    "$factors" => StateBinding::FogFactors,
                    _ => return Err(expected(token, "color or params")),
                }
            }
            "depth" => {
                self.word("range")?;
                StateBinding::DepthRange
            }
            "matrix" => return self.matrix(many),
            _ => {
                let groups = "material, light, lightmodel, lightprod, texenv, fog, depth or matrix";
                return Err(expected(group, groups));
            }
        };
        Ok(vec![one])
    }

    /// Parses a point and the following word.
    fn part(&mut self) -> Parsed<Token<'a>> {
        self.cursor.expect(".", HELP)?;
        Ok(self.cursor.next())
    }

    fn word(&mut self, word: &str) -> Parsed<()> {
        let token = self.part()?;
        if token.text == word { Ok(()) } else { Err(expected(token, word)) }
    }

    /// Parses an index in brackets; the index must be below `count`.
    fn number(&mut self, count: u16) -> Parsed<u8> {
        self.cursor.expect("[", HELP)?;
        let number = operand::index(&mut self.cursor, count - 1)?;
        self.cursor.expect("]", "close the brackets")?;
        // Counts are small.
        Ok(number as u8)
    }

    fn optional_number(&mut self, count: u16) -> Parsed<u8> {
        if self.cursor.peek().text == "[" { self.number(count) } else { Ok(0) }
    }

    /// Parses `.front` or `.back`; front by default.
    fn face(&mut self) -> MaterialFace {
        match self.cursor.after_point(&["front", "back"]) {
            Some("back") => MaterialFace::Back,
            _ => MaterialFace::Front,
        }
    }

    fn material(&mut self) -> Parsed<StateBinding> {
        let face = self.face();
        let token = self.part()?;
        Ok(match (token.text, token.text.parse::<LightingColor>()) {
            (_, Ok(color)) => StateBinding::Material(face, color),
            ("emission", _) => StateBinding::Emission(face),
            ("shininess", _) => StateBinding::Shininess(face),
            _ => return Err(expected(token, "ambient, diffuse, specular, emission or shininess")),
        })
    }

    fn light(&mut self) -> Parsed<StateBinding> {
        let light = self.number(MAX_LIGHTS)?;
        let token = self.part()?;
        Ok(match (token.text, token.text.parse::<LightingColor>()) {
            (_, Ok(color)) => StateBinding::Light(light, color),
            ("position", _) => StateBinding::LightPosition(light),
            ("attenuation", _) => StateBinding::LightAttenuation(light),
            ("half", _) => StateBinding::LightHalf(light),
            ("spot", _) => {
                self.word("direction")?;
                StateBinding::SpotDirection(light)
            }
            _ => {
                let all = "ambient, diffuse, specular, position, attenuation, spot.direction or half";
                return Err(expected(token, all));
            }
        })
    }

    fn light_model(&mut self) -> Parsed<StateBinding> {
        if self.cursor.after_point(&["ambient"]).is_some() {
            return Ok(StateBinding::LightModelAmbient);
        }
        let face = self.face();
        let token = self.part()?;
        if token.text == "scenecolor" { Ok(StateBinding::SceneColor(face)) } else { Err(expected(token, "scenecolor")) }
    }

    fn light_product(&mut self) -> Parsed<StateBinding> {
        let light = self.number(MAX_LIGHTS)?;
        let face = self.face();
        let token = self.part()?;
        let color = token.text.parse().map_err(|_| expected(token, "ambient, diffuse or specular"))?;
        Ok(StateBinding::LightProduct(light, face, color))
    }

    fn matrix(&mut self, many: bool) -> Parsed<Vec<StateBinding>> {
        let token = self.part()?;
        let matrix = match token.text {
            "modelview" => {
                self.optional_number(1)?;
                StateMatrix::ModelView
            }
            "projection" => StateMatrix::Projection,
            "mvp" => StateMatrix::Mvp,
            "texture" => StateMatrix::Texture(self.optional_number(MAX_TEXTURE_UNITS)?),
            "program" => StateMatrix::Program(self.number(MAX_PROGRAM_MATRICES)?),
            _ => return Err(expected(token, "modelview, projection, mvp, texture or program")),
        };
        let form = self.cursor.after_point(&["inverse", "transpose", "invtrans"]);
        let form = form.and_then(|word| word.parse().ok()).unwrap_or(MatrixForm::Plain);
        let (first, last) = match self.cursor.after_point(&["row"]) {
            Some(_) => self.rows(many)?,
            None => (0, 3),
        };
        Ok((first..=last).map(|row| StateBinding::MatrixRow(matrix, form, row)).collect())
    }

    /// Parses an index in brackets or, if `many`, a range of indices.
    fn rows(&mut self, many: bool) -> Parsed<(u8, u8)> {
        self.cursor.expect("[", "write the number of the row")?;
        let (first, last) = self.range(many, 3)?;
        Ok((first as u8, last as u8))
    }
}

fn expected(token: Token<'_>, what: &str) -> SyntaxError {
    unknown(token, what, HELP)
}
