//! A foot on the ground: how it stands there, and what the ground gives it along the surface.
//!
//! ```text
//!   sticking   H = -k1_h (p_x - a_x - anchor)     at any force                            stores H^2/(2 k1_h)
//!   Coulomb    the same while |H| < mu N, then    H = -+ mu N while it slips to +-1       takes mu N |w|, w the slip rate
//! ```

/// How a foot meets its ground chain.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum Contact {
    /// In the air: no force.
    Open,
    /// Pressing too lightly to hold: no horizontal force yet (see `run`).
    Slide,
    /// Following the ground without any force: the only foot near it, of a body without rotational
    /// inertia (see `strut`).
    Trail,
    /// Pressing, its horizontal spring anchored.
    Stick,
    /// Slipping against friction, to the right (+1) or to the left (-1).
    Slip(f64),
}

/// A foot's contact and the horizontal anchor it landed on (m).
#[derive(Clone, Copy, Debug)]
pub(crate) struct Foot {
    pub contact: Contact,
    pub anchor: f64,
}

impl Foot {
    /// Whether the foot is on the ground.
    #[inline(always)]
    pub(crate) fn closed(&self) -> bool {
        self.contact != Contact::Open
    }

    /// Whether it presses: a trailing foot touches the ground and takes no force.
    pub(crate) fn presses(&self) -> bool {
        self.closed() && self.contact != Contact::Trail
    }

    /// Whether its horizontal spring holds.
    #[inline(always)]
    pub(crate) fn holds(&self) -> bool {
        self.contact == Contact::Stick
    }
}

/// A foot's kinematics and contact forces in one configuration.
#[derive(Clone, Copy, Debug)]
pub(crate) struct FootForce {
    /// dp_x/dtheta (m).
    pub px_th: f64,
    /// dp_z/dtheta (m).
    pub pz_th: f64,
    /// Horizontal force on the foot (N).
    pub horizontal: f64,
    /// Vertical force on the foot, positive when pressing (N).
    pub vertical: f64,
}

/// What a pressing foot can take along the ground.
#[derive(Clone, Copy, Debug)]
pub(crate) enum ContactLaw {
    /// Any force.
    Sticking,
    /// mu N.
    Coulomb {
        /// mu.
        coefficient: f64,
    },
}

impl ContactLaw {
    /// Whether a foot may slip.
    #[inline(always)]
    pub(crate) fn slips(&self) -> bool {
        match self {
            Self::Sticking => false,
            Self::Coulomb { .. } => true,
        }
    }

    /// mu; zero where no foot slips.
    #[inline(always)]
    pub(crate) fn coefficient(&self) -> f64 {
        match *self {
            Self::Sticking => 0.0,
            Self::Coulomb { coefficient } => coefficient,
        }
    }

    /// Force on a foot that presses with N and slips to a side (N); of a slope of N, that of the
    /// force.
    #[inline(always)]
    pub(crate) fn slipping(&self, pressing: f64, side: f64) -> f64 {
        match *self {
            Self::Sticking => 0.0,
            Self::Coulomb { coefficient } => -pressing * coefficient * side,
        }
    }
}
