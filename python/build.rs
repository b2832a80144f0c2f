//! Links the extension so that its own functions answer its own calls.

fn main() {
    println!("cargo:rerun-if-changed=build.rs");
    // Elsewhere a library's calls find the library's symbols first. Under ELF those of the process
    // come first: the C library's sin instead of that of the crate elementary.
    let elf = !matches!(std::env::var("CARGO_CFG_TARGET_OS").as_deref(), Ok("macos" | "windows"));
    if elf {
        println!("cargo:rustc-cdylib-link-arg=-Wl,-Bsymbolic");
    }
}
