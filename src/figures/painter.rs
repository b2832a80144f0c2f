//! The surface that plotters draws on: a backend that paints with anti-aliasing.
//!
//! plotters hands its backend whole numbers, which would make a flat curve jump from pixel to pixel. So this backend
//! tells plotters of a surface `FINE` times finer than the picture, and paints at the fractions of a pixel it gets back.

use std::cell::RefCell;
use std::convert::Infallible;
use std::rc::Rc;

use plotters_backend::text_anchor::{HPos, VPos};
use plotters_backend::{
    BackendColor, BackendCoord, BackendStyle, BackendTextStyle, DrawingBackend, DrawingErrorKind, FontStyle,
    FontTransform,
};

use super::glyph::{self, CAPITAL, Setting};
use super::raster::{Ink, Point, Raster};

/// Units of the backend in one pixel.
pub const FINE: f64 = 16.0;

/// A plotters backend that paints on a shared raster.
pub struct Painter {
    pub raster: Rc<RefCell<Raster>>,
}

type Drawn = Result<(), DrawingErrorKind<Infallible>>;

fn pixel((x, y): BackendCoord) -> Point {
    (f64::from(x) / FINE, f64::from(y) / FINE)
}

fn ink(colour: BackendColor) -> Ink {
    Ink { rgb: colour.rgb, alpha: colour.alpha }
}

fn width<S: BackendStyle>(style: &S) -> f64 {
    f64::from(style.stroke_width()) / FINE
}

impl DrawingBackend for Painter {
    type ErrorType = Infallible;

    fn get_size(&self) -> (u32, u32) {
        let (width, height) = self.raster.borrow().size();
        (width as u32 * FINE as u32, height as u32 * FINE as u32)
    }

    fn ensure_prepared(&mut self) -> Drawn {
        Ok(())
    }

    fn present(&mut self) -> Drawn {
        Ok(())
    }

    fn draw_pixel(&mut self, point: BackendCoord, colour: BackendColor) -> Drawn {
        let (x, y) = pixel(point);
        self.raster.borrow_mut().blend(x.floor() as i64, y.floor() as i64, ink(colour), 1.0);
        Ok(())
    }

    fn draw_line<S: BackendStyle>(&mut self, from: BackendCoord, to: BackendCoord, style: &S) -> Drawn {
        self.raster.borrow_mut().stroke(&[pixel(from), pixel(to)], width(style), ink(style.color()));
        Ok(())
    }

    fn draw_path<S: BackendStyle, I: IntoIterator<Item = BackendCoord>>(&mut self, path: I, style: &S) -> Drawn {
        let points: Vec<Point> = path.into_iter().map(pixel).collect();
        self.raster.borrow_mut().stroke(&points, width(style), ink(style.color()));
        Ok(())
    }

    fn draw_rect<S: BackendStyle>(&mut self, a: BackendCoord, b: BackendCoord, style: &S, fill: bool) -> Drawn {
        let corners = [a, (b.0, a.1), b, (a.0, b.1)];
        if fill { self.fill_polygon(corners, style) } else { self.draw_path(corners.into_iter().chain([a]), style) }
    }

    fn draw_circle<S: BackendStyle>(&mut self, centre: BackendCoord, radius: u32, style: &S, fill: bool) -> Drawn {
        let rim = if fill { None } else { Some(width(style)) };
        self.raster.borrow_mut().circle(pixel(centre), f64::from(radius) / FINE, rim, ink(style.color()));
        Ok(())
    }

    fn fill_polygon<S: BackendStyle, I: IntoIterator<Item = BackendCoord>>(&mut self, path: I, style: &S) -> Drawn {
        let points: Vec<Point> = path.into_iter().map(pixel).collect();
        self.raster.borrow_mut().fill(&points, ink(style.color()));
        Ok(())
    }

    /// The anchor's bottom is the baseline, its top the head of the capitals, its centre the middle between them.
    fn draw_text<T: BackendTextStyle>(&mut self, text: &str, style: &T, at: BackendCoord) -> Drawn {
        let setting = setting(style);
        let along = match style.anchor().h_pos {
            HPos::Left => 0.0,
            HPos::Center => -glyph::length(text, setting) / 2.0,
            HPos::Right => -glyph::length(text, setting),
        };
        let across = setting.size
            * match style.anchor().v_pos {
                VPos::Bottom => 0.0,
                VPos::Center => CAPITAL / 2.0,
                VPos::Top => CAPITAL,
            };
        let (x, y) = pixel(at);
        let start = if setting.upwards { (x + across, y - along) } else { (x + along, y + across) };
        glyph::set(&mut self.raster.borrow_mut(), text, setting, start, ink(style.color()));
        Ok(())
    }

    fn estimate_text_size<T: BackendTextStyle>(
        &self,
        text: &str,
        style: &T,
    ) -> Result<(u32, u32), DrawingErrorKind<Infallible>> {
        let setting = setting(style);
        Ok(((glyph::length(text, setting) * FINE) as u32, (setting.size * CAPITAL * FINE) as u32))
    }
}

fn setting<T: BackendTextStyle>(style: &T) -> Setting {
    Setting {
        bold: matches!(style.style(), FontStyle::Bold),
        size: style.size() / FINE,
        upwards: matches!(style.transform(), FontTransform::Rotate270),
    }
}
