//! `welkin-web-bindgen MODULE.wasm NAME FOLDER`: writes FOLDER/NAME.js, an ES module, and FOLDER/NAME_bg.wasm.

use std::process::ExitCode;

use wasm_bindgen_cli_support::Bindgen;

fn main() -> ExitCode {
    let args: Vec<String> = std::env::args().skip(1).collect();
    let [module, name, folder] = args.as_slice() else {
        eprintln!("usage: welkin-web-bindgen MODULE.wasm NAME FOLDER");
        return ExitCode::from(2);
    };
    match write(module, name, folder) {
        Ok(()) => ExitCode::SUCCESS,
        Err(reason) => {
            eprintln!("error: {module}: {reason}");
            ExitCode::FAILURE
        }
    }
}

fn write(module: &str, name: &str, folder: &str) -> Result<(), String> {
    let mut bindgen = Bindgen::new();
    bindgen
        .input_path(module)
        .out_name(name)
        .typescript(false)
        .remove_name_section(true)
        .remove_producers_section(true);
    bindgen.web(true).map_err(|e| e.to_string())?;
    bindgen.generate(folder).map_err(|e| format!("{e:#}"))
}
