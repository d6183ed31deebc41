//! Flow control of ps_2_a: branches, loops, breaks, calls.

use super::ps_2::{Place, Writer};
use super::{comparison, component};

/// Subroutines that a program can have.
const SUBROUTINES: usize = 2;

impl Writer<'_> {
    /// Instructions with flow control around some of them.
    pub(super) fn block(&mut self, size: usize, depth: usize, place: Place) {
        let count = if depth == 0 { [2, 4, 8, 12][size.min(3)] } else { 3 };
        let deepest = [1, 2, 3, 3][size.min(3)];
        for _ in 0..1 + self.r.below(count) {
            match self.r.below(12) {
                0 | 1 if depth < deepest => self.branch(size, depth, place),
                2 if depth < deepest => self.repeat(size, depth, place),
                3 if depth < 2 => self.call(0),
                _ => self.instruction(place),
            }
        }
    }

    fn condition(&mut self) -> (String, bool) {
        let c = component(self.r);
        match self.r.below(4) {
            0 => (format!("if {}b{}", self.r.of(&["", "", "!"]), self.r.below(2)), false),
            1 => (format!("if {}p0.{c}", self.r.of(&["", "!"])), true),
            _ => {
                let (a, b) = (self.scalar(), if self.r.one_in(3) { "c1.x".to_owned() } else { self.scalar() });
                (format!("if_{} {a}, {b}", comparison(self.r)), true)
            }
        }
    }

    fn branch(&mut self, size: usize, depth: usize, place: Place) {
        let (line, computed) = self.condition();
        let inner = Place { parted: place.parted || computed };
        self.lines.push(line);
        self.block(size, depth + 1, inner);
        if self.r.one_in(2) {
            self.lines.push("else".to_owned());
            self.block(size, depth + 1, inner);
        }
        self.lines.push("endif".to_owned());
    }

    fn repeat(&mut self, size: usize, depth: usize, place: Place) {
        let count = self.r.below(2);
        self.lines.push(format!("rep i{count}"));
        self.block(size, depth + 1, place);
        let mut inner = place;
        match self.r.below(5) {
            0 => {
                let (a, b) = (self.scalar(), self.scalar());
                self.lines.push(format!("break_{} {a}, {b}", comparison(self.r)));
                inner.parted = true;
            }
            1 => {
                let (not, c) = (self.r.of(&["", "!"]), component(self.r));
                self.lines.push(format!("breakp {not}p0.{c}"));
                inner.parted = true;
            }
            2 => {
                let (line, computed) = self.condition();
                self.lines.extend([line, "break".to_owned(), "endif".to_owned()]);
                inner.parted |= computed;
            }
            3 if self.r.one_in(3) => self.lines.push("break".to_owned()),
            _ => {}
        }
        self.instruction(inner);
        self.lines.push("endrep".to_owned());
    }

    /// A call of subroutine `from` or a later one.
    fn call(&mut self, from: usize) {
        let label = from + self.r.below(SUBROUTINES - from);
        self.called = self.called.max(label + 1);
        let c = component(self.r);
        self.lines.push(match self.r.below(3) {
            0 => format!("call l{label}"),
            1 => format!("callnz l{label}, {}b{}", self.r.of(&["", "!"]), self.r.below(2)),
            _ => format!("callnz l{label}, {}p0.{c}", self.r.of(&["", "!"])),
        });
    }

    /// The subroutines that were called, in the order of their labels; one may call the next.
    pub(super) fn subroutines(&mut self) {
        if self.called == 0 {
            return;
        }
        let mut label = 0;
        while label < self.called {
            self.lines.extend(["ret".to_owned(), format!("label l{label}")]);
            for _ in 0..1 + self.r.below(4) {
                self.instruction(Place { parted: true });
            }
            if label + 1 < SUBROUTINES && self.r.one_in(2) {
                self.call(label + 1);
            }
            if self.r.one_in(3) {
                self.branch(0, 2, Place { parted: true });
            }
            label += 1;
        }
        self.lines.push("ret".to_owned());
    }
}
