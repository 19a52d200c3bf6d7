//! The exported functions that both versions have, alike except for their names: the end of an instance's life, its
//! messages, and its saved states. Each version exports them by [`functions`] beside those of its own.

pub(crate) mod exchange;
pub(crate) mod variables;

pub(crate) use crate::arguments::{array, disjoint, state_handle, store, store_all, string};
pub(crate) use crate::boundary::call;
pub(crate) use crate::c_interface::{Component, FmiString, FmuState, Status};
pub(crate) use crate::instance::{Failure, Mode, blob, handles, snapshots};

/// Exports the functions under a version's names, in a file beside its table of modes `functions` that uses all that
/// stands here.
macro_rules! functions {
    (
        boolean: $boolean:ty, byte: $byte:ty, logging: $log:ident,
        free_instance: $free_instance:ident,
        set_debug_logging: $set_debug_logging:ident,
        exit_initialization_mode: $exit_initialization_mode:ident,
        terminate: $terminate:ident,
        reset: $reset:ident,
        get_state: $get_state:ident,
        set_state: $set_state:ident,
        free_state: $free_state:ident,
        serialized_state_size: $serialized_state_size:ident,
        serialize_state: $serialize_state:ident,
        deserialize_state: $deserialize_state:ident,
    ) => {
        /// Ends an instance and frees its saved states. NULL and dead handles are ignored.
        ///
        /// # Safety
        /// `instance` may be any value. The standard forbids a call while another one on the same instance runs; it is
        /// then ignored.
        #[unsafe(no_mangle)]
        pub unsafe extern "C" fn $free_instance(instance: Component) {
            if let Some(instance) = handles::borrow(instance)
                && functions::FREE_INSTANCE.allowed.contains(instance.mode)
            {
                crate::instantiation::free(instance, stringify!($free_instance));
            }
        }

        /// Switches categories of messages as the version wants it, see `Logger`. An unknown category is a warning; the
        /// others are set.
        ///
        /// # Safety
        /// `categories` is null or points to `nCategories` strings, each null or ended by NUL.
        #[unsafe(no_mangle)]
        pub unsafe extern "C" fn $set_debug_logging(
            instance: Component,
            loggingOn: $boolean,
            nCategories: usize,
            categories: *const FmiString,
        ) -> Status {
            call(instance, &functions::SET_DEBUG_LOGGING, |instance| {
                // SAFETY: this function's contract; null is refused.
                let pointers = unsafe { array("categories", categories, nCategories)? };
                let names = pointers
                    .iter()
                    // SAFETY: this function's contract; null is refused.
                    .map(|pointer| unsafe { string("categories", *pointer) })
                    .collect::<Result<Vec<_>, _>>()?;
                let unknown = |name: &str| Failure::UnknownCategory(name.to_owned());
                instance.logger.$log(loggingOn != 0, &names).map_err(unknown)
            })
        }

        /// Finds the static equilibrium at the start time.
        ///
        /// # Safety
        /// `instance` may be any value.
        #[unsafe(no_mangle)]
        pub unsafe extern "C" fn $exit_initialization_mode(instance: Component) -> Status {
            call(instance, &functions::EXIT_INITIALIZATION_MODE, |instance| {
                let clock = instance.clock.ok_or(Failure::NotSetUp)?;
                instance.initialize(clock.start)?;
                let next = if instance.exchange { Mode::Event } else { Mode::StepComplete };
                instance.enter(next, &functions::EXIT_INITIALIZATION_MODE);
                Ok(())
            })
        }

        /// No more steps; results may still be read. A warning if the recording cannot be stored.
        ///
        /// # Safety
        /// `instance` may be any value.
        #[unsafe(no_mangle)]
        pub unsafe extern "C" fn $terminate(instance: Component) -> Status {
            call(instance, &functions::TERMINATE, |instance| {
                let finished = instance.finish_recording(concat!(
                    "stay in memory: ",
                    stringify!($free_instance),
                    " and ",
                    stringify!($reset),
                    " try once more"
                ));
                instance.enter(Mode::Terminated, &functions::TERMINATE);
                finished
            })
        }

        /// As after instantiation. Saved states and the choice of log categories stay. A warning if samples of the
        /// recording could not be stored: they are lost, the instance is as good as new.
        ///
        /// # Safety
        /// `instance` may be any value.
        #[unsafe(no_mangle)]
        pub unsafe extern "C" fn $reset(instance: Component) -> Status {
            call(instance, &functions::RESET, |instance| {
                let unstored = instance.reset()?;
                instance.enter(Mode::Instantiated, &functions::RESET);
                unstored.map_or(Ok(()), Err)
            })
        }

        /// Saves the state; over an earlier one if `*state` is not NULL.
        ///
        /// # Safety
        /// `state` is null or points to a handle.
        #[unsafe(no_mangle)]
        pub unsafe extern "C" fn $get_state(instance: Component, state: *mut FmuState) -> Status {
            call(instance, &functions::GET_FMU_STATE, |instance| {
                // SAFETY: this function's contract; null and misaligned pointers are refused. The handle itself may be
                // any value.
                let handle = unsafe { state_handle(state)? };
                *handle = instance.save(*handle)?;
                Ok(())
            })
        }

        /// Puts a saved state back, mode and time included.
        ///
        /// # Safety
        /// `instance` and `state` may be any value.
        #[unsafe(no_mangle)]
        pub unsafe extern "C" fn $set_state(instance: Component, state: FmuState) -> Status {
            call(instance, &functions::SET_FMU_STATE, |instance| instance.restore(state))
        }

        /// Frees a saved state and sets its handle to NULL. NULL is ignored. A host that passes the state instead of
        /// its address, as fmusim (the program in C) does, has it freed all the same; the log warns.
        ///
        /// # Safety
        /// `state` is null or points to a handle.
        #[unsafe(no_mangle)]
        pub unsafe extern "C" fn $free_state(instance: Component, state: *mut FmuState) -> Status {
            call(instance, &functions::FREE_FMU_STATE, |instance| {
                if state.is_null() {
                    return Ok(());
                }
                if snapshots::is_handle(state.addr()) {
                    return instance.free_by_value(state.cast(), stringify!($free_state));
                }
                // SAFETY: this function's contract; misaligned pointers are refused. The handle itself may be any
                // value.
                let handle = unsafe { state_handle(state)? };
                if !handle.is_null() {
                    instance.snapshots.free(*handle)?;
                    *handle = std::ptr::null_mut();
                }
                Ok(())
            })
        }

        /// Number of bytes of a saved state.
        ///
        /// # Safety
        /// `size` is null or points to a number.
        #[unsafe(no_mangle)]
        pub unsafe extern "C" fn $serialized_state_size(
            instance: Component,
            state: FmuState,
            size: *mut usize,
        ) -> Status {
            call(instance, &functions::SERIALIZED_FMU_STATE_SIZE, |instance| {
                let length = blob::length(instance.snapshots.get(state)?);
                // SAFETY: this function's contract; null and misaligned pointers are refused.
                unsafe { store("size", size, length) }
            })
        }

        /// A saved state as bytes; `size` must be the number of them.
        ///
        /// # Safety
        /// `serializedState` is null or points to `size` bytes.
        #[unsafe(no_mangle)]
        pub unsafe extern "C" fn $serialize_state(
            instance: Component,
            state: FmuState,
            serializedState: *mut $byte,
            size: usize,
        ) -> Status {
            call(instance, &functions::SERIALIZE_FMU_STATE, |instance| {
                let bytes = blob::encode(instance.snapshots.get(state)?, instance.model.guid());
                if size != bytes.len() {
                    return Err(Failure::Size { given: size, needed: bytes.len() });
                }
                // SAFETY: this function's contract; null is refused.
                unsafe { store_all("serializedState", serializedState.cast::<u8>(), &bytes) }
            })
        }

        /// A saved state from bytes; over an earlier one if `*state` is not NULL.
        ///
        /// # Safety
        /// `serializedState` is null or points to `size` bytes; `state` is null or points to a handle.
        #[unsafe(no_mangle)]
        pub unsafe extern "C" fn $deserialize_state(
            instance: Component,
            serializedState: *const $byte,
            size: usize,
            state: *mut FmuState,
        ) -> Status {
            call(instance, &functions::DESERIALIZE_FMU_STATE, |instance| {
                disjoint(serializedState, size, state, 1)?;
                // SAFETY: this function's contract; null, misaligned and overlapping pointers are refused. The handle
                // itself may be any value.
                let handle = unsafe { state_handle(state)? };
                // SAFETY: as above.
                let bytes = unsafe { array("serializedState", serializedState.cast::<u8>(), size)? };
                let snapshot = blob::decode(bytes, instance.model.guid(), &instance.simulation)?;
                *handle = instance.snapshots.put(*handle, |_| Some(snapshot))?;
                Ok(())
            })
        }
    };
}

pub(crate) use functions;
