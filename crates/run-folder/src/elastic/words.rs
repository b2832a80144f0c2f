//! Over how much of a record something is compared, in words.

use frames::answer::{Compared, ComparedEnd};

/// Over how much of a record something is compared.
pub fn over(compared: &Compared) -> String {
    let seconds = compared.seconds;
    match compared.end {
        ComparedEnd::Record => "over all of it".into(),
        ComparedEnd::History => format!("over its first {seconds:.2} s, where it ends"),
        ComparedEnd::Foretold => format!(
            "over its first {seconds:.2} s; from then on no model foretells this motion one to \
             one: it is to be judged over many"
        ),
        ComparedEnd::Slides => format!(
            "over its first {seconds:.2} s; then a corner slides as it lands: how far depends on \
             friction, and these springs follow no further"
        ),
    }
}
