//! What users give, as finite elements.
//!
//! Dashpots in the sections give the ratio to critical damping that is asked for: across, of the
//! lowest mode of the fixed structure; along a pier's column or a portal's, of the mass on it.
//!
//! ```text
//!   column of a pier     eta_I = 2 zeta m omega EI/k, which is L^3/3 of the rest if it is rigid in shear        eta_A = 2 zeta_a sqrt(EA m/L) L
//!   legs of an A-frame   eta/stiffness = 2 zeta/omega        omega: across
//! ```

use std::f64::consts::TAU;

use super::{AFrameSpec, ElasticStructure, PierSpec, PortalSpec};
use crate::{
    beam::BeamSection,
    frame::{Cantilever, Footing, FrameLayout, LeggedFrame, Portal, StraightMember},
};

impl ElasticStructure {
    /// The structure as nodes, footings and beams.
    pub fn layout(&self) -> FrameLayout {
        match self {
            Self::Pier(pier) => pier.finite().layout(),
            Self::AFrame(frame) => frame.finite(self.damping_share(frame.damping_ratio)).layout(),
            Self::Frame(frame) => frame.finite(self.damping_share(frame.damping_ratio)).layout(),
        }
    }

    /// Lowest frequency of the structure fixed to the ground, under its weight, as it is modelled
    /// (Hz): of a pier in closed form, of frames that of their finite elements, for closed forms
    /// leave out the rotational inertia at the top, and how columns shorten or legs bend.
    pub fn fixed_base_frequency_hz(&self) -> f64 {
        let layout = match self {
            Self::Pier(pier) => return pier.frequency(),
            Self::AFrame(frame) => frame.finite(0.0).layout(),
            Self::Frame(frame) => frame.finite(0.0).layout(),
        };
        let lowest = || {
            let frame = layout.fixed().frame().ok()?;
            let standing = frame.standing(&[]).ok()?;
            frame.frequencies(&standing).first().copied()
        };
        lowest().unwrap_or_else(|| self.frequency_hz())
    }

    /// Damping over stiffness (s) at which the lowest mode of the structure fixed to the ground has
    /// a ratio to critical damping.
    fn damping_share(&self, ratio: f64) -> f64 {
        2.0 * ratio / (TAU * self.fixed_base_frequency_hz())
    }
}

impl ElasticStructure {
    /// One column with so many elements and what it carries; none if columns have no mass of their
    /// own, and therefore no waves.
    pub(crate) fn column_alone(&self, elements: usize) -> Option<FrameLayout> {
        match self {
            Self::Pier(pier) if pier.column_mass_kg > 0.0 => {
                Some(PierSpec { elements: Some(elements), ..*pier }.finite().layout())
            }
            Self::Frame(frame) if frame.column_mass_kg > 0.0 => {
                let Portal { height, mass, inertia, footing, column, .. } =
                    PortalSpec { elements: Some(elements), ..*frame }
                        .finite(self.damping_share(frame.damping_ratio));
                Some(
                    Cantilever {
                        mass,
                        inertia: Some(inertia),
                        height,
                        footing,
                        column,
                        consistent: false,
                    }
                    .layout(),
                )
            }
            _ => None,
        }
    }

    /// The same with twice as many elements to a column; none of columns without mass, which have
    /// one.
    pub(crate) fn with_doubled_elements(&self) -> Option<Self> {
        match self {
            Self::Pier(pier) if pier.column_mass_kg > 0.0 => {
                Some(Self::Pier(PierSpec { elements: Some(2 * pier.elements()), ..*pier }))
            }
            Self::Frame(frame) if frame.column_mass_kg > 0.0 => {
                Some(Self::Frame(PortalSpec { elements: Some(2 * frame.elements()), ..*frame }))
            }
            _ => None,
        }
    }
}

impl PierSpec {
    fn finite(&self) -> Cantilever {
        let (length, ei, ea) = (self.length(), self.ei(), self.ea());
        let omega = TAU * self.frequency();
        let section = BeamSection {
            axial: ea,
            bending: ei,
            shear: self.ga(),
            axial_damping: 2.0
                * self.axial_damping_ratio()
                * (ea * self.moving_mass() * length).sqrt(),
            bending_damping: 2.0 * self.damping_ratio * self.moving_mass() * omega * length.powi(3)
                / 3.0
                * (1.0 + self.shear_flexibility()),
            line_mass: self.column_mass_kg / length,
        };
        Cantilever {
            mass: self.mass_kg,
            inertia: None,
            height: self.height_m,
            footing: Footing {
                width: self.width_m,
                mass: self.footing_mass_kg,
                inertia: self.footing_inertia(),
                centre: 0.5 * self.footing_height_m,
                top: self.footing_height_m,
            },
            column: StraightMember { section, elements: self.elements() },
            consistent: false,
        }
    }
}

impl AFrameSpec {
    /// Its model, of this damping over stiffness (s).
    fn finite(&self, share: f64) -> LeggedFrame {
        let section = BeamSection {
            axial: self.ea_n,
            bending: self.ei_nm2,
            shear: f64::INFINITY,
            axial_damping: share * self.ea_n,
            bending_damping: share * self.ei_nm2,
            line_mass: 0.0,
        };
        LeggedFrame {
            mass: self.mass_kg,
            inertia: self.inertia(),
            height: self.height_m,
            width: self.width_m,
            foot_mass: self.foot_mass_kg,
            leg: StraightMember { section, elements: 1 },
        }
    }
}

impl PortalSpec {
    /// Its model, of this damping over the stiffness in bending (s).
    fn finite(&self, share: f64) -> Portal {
        let (mass, inertia) = self.top();
        let section = |ea: f64, ei: f64, length: f64, mass: f64, line_mass: f64| BeamSection {
            axial: ea,
            bending: ei,
            shear: f64::INFINITY,
            axial_damping: 2.0 * self.damping_ratio * (ea * mass * length).sqrt(),
            bending_damping: share * ei,
            line_mass,
        };
        let length = self.length();
        let column = section(
            self.column_ea_n,
            self.column_ei_nm2,
            length,
            mass,
            self.column_mass_kg / length,
        );
        let column = BeamSection { shear: self.column_ga(), ..column };
        // its two ends against each other: half of the mass at one
        let girder = section(self.beam_ea_n, self.beam_ei_nm2, self.span_m, 0.5 * mass, 0.0);
        Portal {
            span: self.span_m,
            height: self.height_m,
            mass,
            inertia,
            footing: Footing {
                width: self.footing_width_m,
                mass: self.footing_mass_kg,
                inertia: self.footing_inertia(),
                centre: 0.5 * self.footing_height_m,
                top: self.footing_height_m,
            },
            column: StraightMember { section: column, elements: self.elements() },
            girder: StraightMember { section: girder, elements: 1 },
        }
    }
}
