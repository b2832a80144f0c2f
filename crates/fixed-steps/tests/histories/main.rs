//! Histories in fixed steps of bodies and frames that rock.

mod common;
mod elastic;
mod events;
mod rigid;
