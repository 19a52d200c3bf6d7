//! The exported functions that both versions have, alike but for their names: the end of an instance's life, its
//! messages, and its saved states. Each version exports them by [`functions`] beside those of its own.

/// Exports the functions under a version's names. Where it is called, `functions` is the version's table of modes, and
/// `Status`, `FmiString` and `FmuState` are its types.
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
        #[doc = concat!("`", stringify!($free_instance), "`: ends an instance and frees its saved states. NULL and")]
        /// dead handles are ignored.
        ///
        /// # Safety
        /// `instance` may be any value. The standard forbids a call while another one on the same instance runs; it is
        /// then ignored.
        #[unsafe(no_mangle)]
        pub unsafe extern "C" fn $free_instance(instance: $crate::c_interface::Component) {
            if let Ok(instance) = $crate::instance::handles::borrow(instance)
                && functions::FREE_INSTANCE.allowed.contains(instance.mode)
            {
                $crate::instantiation::free(instance, stringify!($free_instance));
            }
        }

        #[doc = concat!("`", stringify!($set_debug_logging), "`, by the rules of")]
        #[doc = concat!("`Logger::", stringify!($log), "`. An unknown category is a warning; the others are set.")]
        ///
        /// # Safety
        /// `categories` is null or points to `nCategories` strings, each null or ended by NUL.
        #[unsafe(no_mangle)]
        pub unsafe extern "C" fn $set_debug_logging(
            instance: $crate::c_interface::Component,
            loggingOn: $boolean,
            nCategories: usize,
            categories: *const FmiString,
        ) -> Status {
            $crate::boundary::call(instance, &functions::SET_DEBUG_LOGGING, |instance| {
                // SAFETY: this function's contract; null is refused.
                let pointers = unsafe { $crate::arguments::array("categories", categories, nCategories)? };
                let names = pointers
                    .iter()
                    // SAFETY: this function's contract; null is refused.
                    .map(|pointer| unsafe { $crate::arguments::string("categories", *pointer) })
                    .collect::<Result<Vec<_>, _>>()?;
                let unknown = |name: &str| $crate::instance::Failure::UnknownCategory(name.to_owned());
                instance.logger.$log(loggingOn != 0, &names).map_err(unknown)
            })
        }

        #[doc = concat!("`", stringify!($exit_initialization_mode), "`: finds the static equilibrium at the start")]
        /// time.
        ///
        /// # Safety
        /// `instance` may be any value.
        #[unsafe(no_mangle)]
        pub unsafe extern "C" fn $exit_initialization_mode(instance: $crate::c_interface::Component) -> Status {
            $crate::boundary::call(instance, &functions::EXIT_INITIALIZATION_MODE, |instance| {
                let clock = instance.clock.ok_or($crate::instance::Failure::NotSetUp)?;
                instance.initialize(clock.start)?;
                instance.enter($crate::instance::Mode::StepComplete, &functions::EXIT_INITIALIZATION_MODE);
                Ok(())
            })
        }

        #[doc = concat!("`", stringify!($terminate), "`: no more steps; results may still be read. A warning if the")]
        /// recording cannot be stored.
        ///
        /// # Safety
        /// `instance` may be any value.
        #[unsafe(no_mangle)]
        pub unsafe extern "C" fn $terminate(instance: $crate::c_interface::Component) -> Status {
            $crate::boundary::call(instance, &functions::TERMINATE, |instance| {
                let finished = instance.finish_recording(concat!(
                    "stay in memory: ",
                    stringify!($free_instance),
                    " and ",
                    stringify!($reset),
                    " try once more"
                ));
                instance.enter($crate::instance::Mode::Terminated, &functions::TERMINATE);
                finished
            })
        }

        #[doc = concat!("`", stringify!($reset), "`: as after instantiation. Saved states and the choice of log")]
        /// categories stay. A warning if samples of the recording could not be stored: they are lost, the instance is
        /// as good as new.
        ///
        /// # Safety
        /// `instance` may be any value.
        #[unsafe(no_mangle)]
        pub unsafe extern "C" fn $reset(instance: $crate::c_interface::Component) -> Status {
            $crate::boundary::call(instance, &functions::RESET, |instance| {
                let unstored = instance.reset()?;
                instance.enter($crate::instance::Mode::Instantiated, &functions::RESET);
                unstored.map_or(Ok(()), Err)
            })
        }

        #[doc = concat!("`", stringify!($get_state), "`: saves the state; over an earlier one if `*state` is not")]
        /// NULL.
        ///
        /// # Safety
        /// `state` is null or points to a handle.
        #[unsafe(no_mangle)]
        pub unsafe extern "C" fn $get_state(instance: $crate::c_interface::Component, state: *mut FmuState) -> Status {
            $crate::boundary::call(instance, &functions::GET_FMU_STATE, |instance| {
                // SAFETY: this function's contract; null and misaligned pointers are refused. The handle itself may be
                // any value.
                let handle = unsafe { $crate::arguments::state_handle(state)? };
                *handle = instance.save(*handle)?;
                Ok(())
            })
        }

        #[doc = concat!("`", stringify!($set_state), "`: puts a saved state back, mode and time included.")]
        ///
        /// # Safety
        /// `instance` and `state` may be any value.
        #[unsafe(no_mangle)]
        pub unsafe extern "C" fn $set_state(instance: $crate::c_interface::Component, state: FmuState) -> Status {
            $crate::boundary::call(instance, &functions::SET_FMU_STATE, |instance| instance.restore(state))
        }

        #[doc = concat!("`", stringify!($free_state), "`: frees a saved state and sets its handle to NULL. NULL is")]
        /// ignored. A host that passes the state instead of its address, as fmusim (the program in C) does, has it
        /// freed all the same; the log warns.
        ///
        /// # Safety
        /// `state` is null or points to a handle.
        #[unsafe(no_mangle)]
        pub unsafe extern "C" fn $free_state(instance: $crate::c_interface::Component, state: *mut FmuState) -> Status {
            $crate::boundary::call(instance, &functions::FREE_FMU_STATE, |instance| {
                if state.is_null() {
                    return Ok(());
                }
                if $crate::instance::snapshots::is_handle(state.addr()) {
                    return instance.free_by_value(state.cast(), stringify!($free_state));
                }
                // SAFETY: this function's contract; misaligned pointers are refused. The handle itself may be any
                // value.
                let handle = unsafe { $crate::arguments::state_handle(state)? };
                if !handle.is_null() {
                    instance.snapshots.free(*handle)?;
                    *handle = std::ptr::null_mut();
                }
                Ok(())
            })
        }

        #[doc = concat!("`", stringify!($serialized_state_size), "`: number of bytes of a saved state.")]
        ///
        /// # Safety
        /// `size` is null or points to a number.
        #[unsafe(no_mangle)]
        pub unsafe extern "C" fn $serialized_state_size(
            instance: $crate::c_interface::Component,
            state: FmuState,
            size: *mut usize,
        ) -> Status {
            $crate::boundary::call(instance, &functions::SERIALIZED_FMU_STATE_SIZE, |instance| {
                let length = $crate::instance::blob::length(instance.snapshots.get(state)?);
                // SAFETY: this function's contract; null and misaligned pointers are refused.
                unsafe { $crate::arguments::store("size", size, length) }
            })
        }

        #[doc = concat!("`", stringify!($serialize_state), "`: a saved state as bytes; `size` must be the one that")]
        #[doc = concat!("`", stringify!($serialized_state_size), "` gives.")]
        ///
        /// # Safety
        /// `serializedState` is null or points to `size` bytes.
        #[unsafe(no_mangle)]
        pub unsafe extern "C" fn $serialize_state(
            instance: $crate::c_interface::Component,
            state: FmuState,
            serializedState: *mut $byte,
            size: usize,
        ) -> Status {
            $crate::boundary::call(instance, &functions::SERIALIZE_FMU_STATE, |instance| {
                let bytes = $crate::instance::blob::encode(instance.snapshots.get(state)?, instance.model.guid());
                if size != bytes.len() {
                    return Err($crate::instance::Failure::Size { given: size, needed: bytes.len() });
                }
                // SAFETY: this function's contract; null is refused.
                unsafe { $crate::arguments::store_all("serializedState", serializedState.cast::<u8>(), &bytes) }
            })
        }

        #[doc = concat!("`", stringify!($deserialize_state), "`: a saved state from bytes; over an earlier one if")]
        /// `*state` is not NULL.
        ///
        /// # Safety
        /// `serializedState` is null or points to `size` bytes; `state` is null or points to a handle.
        #[unsafe(no_mangle)]
        pub unsafe extern "C" fn $deserialize_state(
            instance: $crate::c_interface::Component,
            serializedState: *const $byte,
            size: usize,
            state: *mut FmuState,
        ) -> Status {
            $crate::boundary::call(instance, &functions::DESERIALIZE_FMU_STATE, |instance| {
                $crate::arguments::disjoint(serializedState, size, state, 1)?;
                // SAFETY: this function's contract; null, misaligned and overlapping pointers are refused. The handle
                // itself may be any value.
                let handle = unsafe { $crate::arguments::state_handle(state)? };
                // SAFETY: as above.
                let bytes = unsafe { $crate::arguments::array("serializedState", serializedState.cast::<u8>(), size)? };
                let snapshot = $crate::instance::blob::decode(bytes, instance.model.guid(), &instance.simulation)?;
                *handle = instance.snapshots.put(*handle, |_| Some(snapshot))?;
                Ok(())
            })
        }
    };
}

pub(crate) use functions;
