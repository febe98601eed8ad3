//! Copies the examples to where maturin takes them from into the wheel, as heeltoe/examples (pyproject.toml).

use std::fs::{copy, create_dir_all};
use std::path::{Path, PathBuf};

fn main() -> std::io::Result<()> {
    let root = Path::new("../../examples");
    let out = PathBuf::from(std::env::var_os("OUT_DIR").expect("cargo sets OUT_DIR")).join("examples");
    if out.exists() {
        std::fs::remove_dir_all(&out)?;
    }
    println!("cargo::rerun-if-changed={}", root.display());
    for folder in ["", "studies", "thesis"] {
        create_dir_all(out.join(folder))?;
        for entry in root.join(folder).read_dir()? {
            let path = entry?.path();
            if path.extension().is_some_and(|ending| ending == "toml") {
                copy(
                    &path,
                    out.join(folder)
                        .join(path.file_name().expect("a file has a name")),
                )?;
            }
        }
    }
    Ok(())
}
