//! A state that goes through bytes into another process continues there with the same bits; a process that is short of
//! memory, or forked at any time, goes on.

use crate::two::{Host, Resources, bits};
use brinell_fmi::fmi2::*;
use std::path::PathBuf;
use std::process::Command;
use std::sync::Arc;
use std::{env, fs};

const FOLDER: &str = "BRINELL_TEST_STATE";
const STEP: f64 = 2e-6;
const COUNT: u32 = 30;

/// The reals after each of some steps from `from`.
fn run(host: &Host, from: f64) -> String {
    let mut lines = format!("{:x?}\n", bits(&host.all()));
    for n in 0..COUNT {
        assert_eq!(host.step(from + f64::from(n) * STEP, STEP), Status::Ok, "{:?}", host.lines());
        lines += &format!("{:x?}\n", bits(&host.all()));
    }
    lines
}

/// Runs in the other process: takes the state that is in the folder, and leaves what became of it.
#[test]
#[ignore = "started by the tests below, in a process of its own"]
fn child() {
    let Some(folder) = env::var_os(FOLDER).map(PathBuf::from) else {
        println!("skipped: started alone, there is no state to take");
        return;
    };
    let text = fs::read_to_string(folder.join("scene.toml")).unwrap();
    let host = Host::with(Resources::new(&text, None, "resources"), "another process", true);
    let state = host.deserialize(&fs::read(folder.join("state")).unwrap()).unwrap();
    assert_eq!(host.restore(state), Status::Ok, "{:?}", host.lines());
    fs::write(folder.join("result"), run(&host, host.last_time())).unwrap();
}

fn continues_elsewhere(resources: Resources, lead: f64) {
    let host = Host::with(resources, "this process", true);
    host.start();
    // Not along the way that the other process will go.
    let mut time = 0.0;
    for part in [0.4, 0.35, 0.25] {
        assert_eq!(host.step(time, part * lead), Status::Ok, "{:?}", host.lines());
        time += part * lead;
    }
    let lookups = host.get_integers(&[host.reference("solver.rejected_steps")]).unwrap();
    assert!(lookups[0] > 0, "something has happened before the state is taken");
    let folder = host.resources.directory.clone();
    fs::write(folder.join("state"), host.serialize(host.save())).unwrap();
    let expected = run(&host, time);

    let output = Command::new(env::current_exe().unwrap())
        .args(["fmi2::processes::child", "--exact", "--ignored"])
        .env(FOLDER, &folder)
        .output()
        .unwrap();
    assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stdout));
    assert!(fs::read_to_string(folder.join("result")).unwrap() == expected, "other bits");
}

#[test]
fn a_state_taken_in_an_impact_continues_in_another_process_with_the_same_bits() {
    // 10.2 ms: element 1 strikes the trailing edge of the spall.
    continues_elsewhere(Resources::of("er16k-tb1"), 10.2e-3);
}

#[test]
fn a_state_taken_with_law_love_continues_in_another_process_with_the_same_bits() {
    // Element 1 enters the spall after 5 ms. The start is beside the edge, or the grid would be solved too often for a
    // test.
    let edited = |text: String| {
        let angle = text.lines().find(|line| line.starts_with("initial_angle_deg")).unwrap();
        text.replace(angle, "initial_angle_deg = -98.3").replace("law = \"hertz\"", "law = \"love\"")
    };
    continues_elsewhere(Resources::edited("er16k-tb1", "resources", edited), 3e-4);
}

/// Runs in a process of its own: makes instances within little memory until there is none left.
#[cfg(target_os = "linux")]
#[test]
#[ignore = "started by the test below, in a process of its own"]
fn child_short_of_memory() {
    use crate::two::Call;
    if env::var_os(FOLDER).is_none() {
        println!("skipped: started alone, it would take this process's memory");
        return;
    }
    let resources = Resources::of("er16k-tb1");
    let pages: u64 = fs::read_to_string("/proc/self/statm").unwrap().split(' ').next().unwrap().parse().unwrap();
    let bytes = pages * 4096 + (48 << 20);
    let limit = libc::rlimit { rlim_cur: bytes, rlim_max: bytes };
    // SAFETY: a pointer to one value.
    assert_eq!(unsafe { libc::setrlimit(libc::RLIMIT_AS, &raw const limit) }, 0);
    let (guid, location) = (&resources.guid, resources.uri());
    let mut made = Vec::new();
    let message = loop {
        let (c, log) = Call::good("one of many", guid, &location).make();
        if c.is_null() {
            break log.take().pop().unwrap().message;
        }
        made.push((c, log));
        assert!(made.len() < 20_000, "more instances than fit");
    };
    assert!(message.contains("out of memory") && made.len() > 10, "{} instances, then: {message}", made.len());
    for (c, _) in made {
        // SAFETY: any handle may be passed.
        unsafe { fmi2FreeInstance(c) };
    }
    // There is room again.
    assert!(!Call::good("the last", guid, &location).make().0.is_null());
}

#[cfg(target_os = "linux")]
#[test]
fn instantiate_answers_null_where_memory_is_short_and_the_process_goes_on() {
    let output = Command::new(env::current_exe().unwrap())
        .args(["fmi2::processes::child_short_of_memory", "--exact", "--ignored", "--test-threads=1"])
        .env(FOLDER, "unused")
        .output()
        .unwrap();
    let said = [output.stdout, output.stderr].map(|text| String::from_utf8_lossy(&text).into_owned()).concat();
    assert!(output.status.success() && said.contains("1 passed"), "{}: {said}", output.status);
}

#[cfg(target_os = "linux")]
#[test]
fn a_process_forked_while_another_thread_makes_instances_makes_its_own() {
    use std::sync::atomic::{AtomicBool, Ordering};
    let (resources, done) = (Arc::new(Resources::of("nu205-healthy")), AtomicBool::new(false));
    std::thread::scope(|scope| {
        scope.spawn(|| {
            while !done.load(Ordering::Relaxed) {
                drop(Host::with(Arc::clone(&resources), "busy", false));
            }
        });
        let mut children = Vec::new();
        for _ in 0..20 {
            // SAFETY: the child makes an instance and ends at once; it drops nothing of its parent's.
            let child = unsafe { libc::fork() };
            if child == 0 {
                // One that waits for ever is ended, with a status of its own.
                unsafe { libc::alarm(60) };
                let host = Host::with(Arc::clone(&resources), "of a child", false);
                let fine = host.setup(None, 0.0, None) == Status::Ok && host.enter() == Status::Ok;
                unsafe { libc::_exit(i32::from(!fine)) };
            }
            children.push(child);
            std::thread::sleep(std::time::Duration::from_millis(3));
        }
        let statuses = children.into_iter().map(|child| {
            let mut status = -1;
            // SAFETY: a pointer to one value.
            assert_eq!(unsafe { libc::waitpid(child, &raw mut status, 0) }, child);
            status
        });
        let statuses: Vec<i32> = statuses.collect();
        done.store(true, Ordering::Relaxed);
        assert_eq!(statuses, [0; 20]);
    });
}
