//! `python.exe` of what stands for a Windows' Python: the interpreter is in the library `python3….dll` beside it.
#![allow(unsafe_code)]

#[cfg(windows)]
fn main() -> Result<(), Box<dyn std::error::Error>> {
    use std::os::windows::ffi::OsStrExt;

    let program = std::env::current_exe()?;
    let folder = program.parent().ok_or("a program lies in a folder")?;
    let is_interpreter = |path: &std::path::PathBuf| {
        let name = path.file_name().and_then(|name| name.to_str()).unwrap_or_default();
        name.starts_with("python3") && name.ends_with(".dll")
    };
    let files = std::fs::read_dir(folder)?.filter_map(|entry| Some(entry.ok()?.path()));
    let library = files.into_iter().find(is_interpreter).ok_or("no python3….dll beside it")?;
    let mut arguments: Vec<Vec<u16>> = std::env::args_os().map(|a| a.encode_wide().chain([0]).collect()).collect();
    let mut pointers: Vec<*mut u16> = arguments.iter_mut().map(|argument| argument.as_mut_ptr()).collect();
    type Main = unsafe extern "C" fn(i32, *mut *mut u16) -> i32;
    // SAFETY: Python's own library; `Py_Main` takes the arguments of a program, each with a zero at its end.
    let status = unsafe {
        let library = libloading::Library::new(library)?;
        library.get::<Main>(b"Py_Main")?(pointers.len() as i32, pointers.as_mut_ptr())
    };
    std::process::exit(status)
}

#[cfg(not(windows))]
fn main() {}
