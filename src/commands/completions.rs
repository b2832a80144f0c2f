//! `tune completions`: what a shell needs to complete commands and options.

use clap::{Args, CommandFactory};
use clap_complete::{Shell, generate};

use super::{Cli, CommandError, terminal};

/// Options of `tune completions`.
#[derive(Debug, Args)]
pub struct CompletionsOptions {
    /// The shell; as in `tune completions bash > ~/.local/share/bash-completion/completions/tune`
    shell: Shell,
}

pub fn run(o: &CompletionsOptions) -> Result<(), CommandError> {
    let mut text = Vec::new();
    generate(o.shell, &mut Cli::command(), "tune", &mut text);
    terminal::stdout(String::from_utf8_lossy(&text))
}
