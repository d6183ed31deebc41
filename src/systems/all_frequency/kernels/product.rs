//! The pixel program that section 6 proposes: G(v) . T_p, with G from textures and T_p interpolated.
//!
//! - t0 and up: the numbers of [`SetLayout`].
//! - s0 and up: G in parabolic maps, four or two terms per map. With two, every second map stores its terms in reverse
//!   order, so that one instruction combines it with the previous map.
//! - Output: the product; in a pass of one channel, all components are that channel. Alpha is 1.

use std::fmt::Write as _;

use super::layout::{COMPONENTS, SetLayout, ViewNumbers};
use crate::card::{PARABOLIC, WrittenKernel, parabolic};

/// The interpolation between texels of G.
#[non_exhaustive]
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash, strum::Display)]
#[strum(serialize_all = "lowercase")]
pub enum MapFilter {
    /// By the sampler, whose weights have few bits.
    #[default]
    Sampler,
    /// By the program: four reads per map and three interpolations.
    Program,
}

/// A pixel program for the products.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct ProductKernel {
    /// The layout of the interpolated numbers.
    pub layout: SetLayout,
    /// Terms per texel: 4 or 2.
    pub terms_per_texel: usize,
    /// The interpolation; with two terms per texel, only the sampler can interpolate.
    pub filter: MapFilter,
    /// Texels along an edge of a map.
    pub side: usize,
    /// True if instructions request the device's partial precision.
    pub is_partial: bool,
}

impl ProductKernel {
    /// The number of maps.
    pub fn maps(&self) -> usize {
        self.layout.terms.div_ceil(self.terms_per_texel)
    }

    fn coordinates(&self) -> String {
        match (self.layout.view, self.filter) {
            (ViewNumbers::Coordinates, MapFilter::Sampler) => format!("t{}", self.layout.view_set()),
            _ => "r0".to_owned(),
        }
    }

    /// Writes the map coordinates, in full precision. For interpolation by the program, they are split into weights and
    /// the center of the upper left of four texels, so that a nearest read certainly gets that texel.
    fn push_coordinates(&self, text: &mut String) {
        let view = format!("t{}", self.layout.view_set());
        let given = match self.layout.view {
            ViewNumbers::Coordinates => view,
            ViewNumbers::Vector => {
                text.push_str(&parabolic(&view));
                "r0".to_owned()
            }
        };
        if self.filter == MapFilter::Program {
            let _ = write!(
                text,
                "; four texels and the weights between them\nmad r0.xy, {given}, c1.x, c1.y\nfrc r1.xy, r0\n\
                 add r0.xy, r0, -r1\nmad r0.xy, r0, c1.z, c1.w\nadd r2.xy, r0, c2\nadd r3.xy, r0, c3\n\
                 add r4.xy, r0, c4\n"
            );
        }
    }

    /// Reads four terms of G into r5.
    fn push_terms(&self, text: &mut String, quad: usize, pp: &str) {
        if self.filter == MapFilter::Program {
            for (register, coordinates) in [(5, 0), (6, 2), (7, 3), (8, 4)] {
                let _ = writeln!(text, "texld{pp} r{register}, r{coordinates}, s{quad}");
            }
            let _ = write!(text, "lrp{pp} r9, r1.x, r6, r5\nlrp{pp} r10, r1.x, r8, r7\nlrp{pp} r5, r1.y, r10, r9\n");
            return;
        }
        let coordinates = self.coordinates();
        if self.terms_per_texel == 4 {
            let _ = writeln!(text, "texld{pp} r5, {coordinates}, s{quad}");
            return;
        }
        let _ = writeln!(text, "texld{pp} r5, {coordinates}, s{}", 2 * quad);
        if 2 * quad + 1 < self.maps() {
            let _ = writeln!(text, "texld{pp} r6, {coordinates}, s{}\nmov{pp} r5.zw, r6.wzyx", 2 * quad + 1);
        }
    }

    /// The component of the sum for a channel; all components if there is one channel.
    fn channel(&self, channel: usize) -> String {
        if self.layout.channels == 1 { String::new() } else { format!(".{}", COMPONENTS[channel]) }
    }

    fn push_dots(&self, text: &mut String, quad: usize, pp: &str) {
        let into = if quad == 0 { "r11" } else { "r9" };
        for channel in 0..self.layout.channels {
            let set = self.layout.place(4 * quad, channel).0;
            let _ = writeln!(text, "dp4{pp} {into}{}, r5, t{set}", self.channel(channel));
        }
        if quad > 0 {
            let mask = if self.layout.channels == 1 { "" } else { ".xyz" };
            let _ = writeln!(text, "add{pp} r11{mask}, r11, r9");
        }
    }

    fn push_loose(&self, text: &mut String, pp: &str) {
        for (loose, term) in COMPONENTS.iter().enumerate().take(self.layout.loose()) {
            for channel in 0..self.layout.channels {
                let (set, component) = self.layout.place(4 * self.layout.quads() + loose, channel);
                let (into, component) = (self.channel(channel), COMPONENTS[component]);
                let _ = if loose == 0 && self.layout.quads() == 0 {
                    writeln!(text, "mul{pp} r11{into}, r5.{term}, t{set}.{component}")
                } else {
                    writeln!(text, "mad{pp} r11{into}, r5.{term}, t{set}.{component}, r11")
                };
            }
        }
    }
}

impl WrittenKernel for ProductKernel {
    fn name(&self) -> String {
        let SetLayout { terms, channels, view } = self.layout;
        let precision = if self.is_partial { ", partial precision" } else { "" };
        format!(
            "product_{terms}x{channels}, {view}, {} maps of {} filtered by the {}{precision}",
            self.maps(),
            self.side,
            self.filter
        )
    }

    fn text(&self) -> String {
        let pp = if self.is_partial { "_pp" } else { "" };
        let mut text = format!("ps_2_0\n; {}\n{PARABOLIC}", self.name());
        if self.filter == MapFilter::Program {
            let (side, step) = (self.side as f64, 1.0 / self.side as f64);
            let _ = write!(
                text,
                "def c1, {side}, -0.5, {step}, {}\ndef c2, {step}, 0, 0, 0\ndef c3, 0, {step}, 0, 0\n\
                 def c4, {step}, {step}, 0, 0\n",
                step / 2.0
            );
        }
        (0..self.layout.sets()).for_each(|set| {
            let _ = writeln!(text, "dcl t{set}");
        });
        (0..self.maps()).for_each(|map| {
            let _ = writeln!(text, "dcl_2d s{map}");
        });
        self.push_coordinates(&mut text);
        for quad in 0..self.layout.terms.div_ceil(4) {
            self.push_terms(&mut text, quad, pp);
            if quad < self.layout.quads() {
                self.push_dots(&mut text, quad, pp);
            } else {
                self.push_loose(&mut text, pp);
            }
        }
        let _ = write!(text, "mov{pp} r11.w, c0.x\nmov oC0, r11\n");
        text
    }
}
