//! Pictures of the results: plain numbers in, an SVG out, and a PNG with the feature `png`; no
//! physics.
//!
//! Each figure is a module with one input struct of slices and labels and one function
//! `draw(&data)`, which gives a [`Sheet`]: an SVG, which plotters writes, and a PNG of the same
//! shapes, which tiny-skia draws, with an embedded font. A picture is 1600 pixels wide and readable
//! at half that size. It is written whole or not at all, and the same numbers give the same bytes.
//! Figures share nothing, so a program may draw them in parallel. The first line of a title is its
//! head, further ones are remarks.
//!
//! | module | shows |
//! |---|---|
//! | [`history`] | horizontal and vertical displacement against time, finite element against Housner (the paper's Figure 4); with a third history and the differences, the comparison with another program |
//! | [`arr`] | amplitude response ratio against frequency ratio: target, fits, active points |
//! | [`candidates`] | error of every sampled candidate against its two Omega_n |
//! | [`front`] | error against Omega_n, and what stiffness costs |
//! | [`chart`] | the design from the geometry over slenderness and Omega_n/p |
//! | [`contact`] | forces between feet and ground against time |
//! | [`energy`] | the energy account against time |
//! | [`validation`] | two models over many records |
//! | [`record`] | acceleration and velocity of a ground motion, and the level that lifts a structure |
//! | [`fragility`], [`ida`] | probabilities and peaks against the intensity of many ground motions |
//! | [`overturning`], [`rocking`] | what overturns over a pulse's frequency; peaks over size and slenderness |
//! | [`peaks`] | peaks of two models over a sweep |
//! | [`precision`] | run time against error of several tools |

#![warn(missing_docs)]

use std::path::PathBuf;

use thiserror::Error;

mod canvas;
mod font;
mod legend;
mod lettering;
mod mark;
mod number;
mod panel;
#[cfg(feature = "png")]
mod pixels;
mod plot;
mod scale;
mod shape;
mod sheet;
mod style;
mod svg;

pub mod arr;
pub mod candidates;
pub mod chart;
pub mod contact;
pub mod energy;
pub mod fragility;
pub mod front;
pub mod history;
pub mod ida;
pub mod overturning;
pub mod peaks;
pub mod precision;
pub mod record;
pub mod rocking;
pub mod stack;
pub mod validation;

pub use number::{brief, prefix, short};
pub use plot::EventMark;
pub use sheet::Sheet;

#[cfg(test)]
mod tests;

/// A figure with its name and what it is.
#[derive(Debug)]
pub struct Figure {
    /// Its files' name, without an ending.
    pub name: &'static str,
    /// What it is, for a page.
    pub caption: &'static str,
    /// As it was drawn.
    pub sheet: Sheet,
}

/// Why a figure was not drawn; nothing has been written then.
#[derive(Debug, Error)]
#[allow(missing_docs)] // messages say what variants and their fields are
pub enum FigureError {
    #[error(
        "figure {figure}: {what} is empty; give at least {least} values or leave the figure out"
    )]
    Empty { figure: &'static str, what: String, least: usize },
    #[error(
        "figure {figure}: {what}[{index}] is {value}, which cannot be drawn; remove it or mend \
         what computed it"
    )]
    NotFinite { figure: &'static str, what: String, index: usize, value: f64 },
    #[error(
        "figure {figure}: {what} has {found} values where {wanted} are wanted; give slices of one \
         length"
    )]
    Length { figure: &'static str, what: String, found: usize, wanted: usize },
    #[error("figure: cannot write {path}: {source}; check that the folder exists and may be \
             written to", path = path.display())]
    Write { path: PathBuf, source: std::io::Error },
    #[error("figure: cannot draw: {reason}; please report this")]
    Draw { reason: String },
}

/// What is being checked: the figure's name, for the messages.
struct Check(&'static str);

impl Check {
    /// At least `least` values.
    fn least(&self, what: &str, found: usize, least: usize) -> Result<(), FigureError> {
        if found < least {
            Err(FigureError::Empty { figure: self.0, what: what.into(), least })
        } else {
            Ok(())
        }
    }

    /// No NaN and no infinity.
    fn finite(&self, what: &str, values: &[f64]) -> Result<(), FigureError> {
        self.each(what, values, |x| x.is_finite())
    }

    /// Two times or more, all finite; how many.
    fn times(&self, t: &[f64]) -> Result<usize, FigureError> {
        self.least("t", t.len(), 2)?;
        self.finite("t", t)?;
        Ok(t.len())
    }

    /// Every value passes.
    fn each(
        &self,
        what: &str,
        values: &[f64],
        passes: impl Fn(f64) -> bool,
    ) -> Result<(), FigureError> {
        match values.iter().position(|&x| !passes(x)) {
            None => Ok(()),
            Some(index) => Err(FigureError::NotFinite {
                figure: self.0,
                what: what.into(),
                index,
                value: values[index],
            }),
        }
    }

    /// As many values as wanted, all finite.
    fn column(&self, what: &str, values: &[f64], wanted: usize) -> Result<(), FigureError> {
        if values.len() != wanted {
            return Err(FigureError::Length {
                figure: self.0,
                what: what.into(),
                found: values.len(),
                wanted,
            });
        }
        self.finite(what, values)
    }
}
