//! Environments: a robot, a scene and facts, prepared for any number of policies.

use std::ffi::c_char;

use motet_decode::{AcceptorFactory, Environment, Modifiers, Subset};
use motet_syntax::{FileId, Source, Sources, Syntax, render};

use crate::border::{free, guarded, handle, shared, slice, string, string_out};

/// The texts of an environment. Each string is UTF-8 that ends with a null byte; null is a text that is not
/// given. An environment without a robot offers all primitives of the standard library. Motions are left to
/// the run.
#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct MotetEnvironmentTexts {
    /// The name of a built-in robot, or the text of a `robot.toml`.
    pub robot: *const c_char,
    /// The text of the `primitives.motet` beside it.
    pub declarations: *const c_char,
    /// The name of a built-in scene, or the text of one in JSON.
    pub scene: *const c_char,
    /// Facts at the start, in JSON: `{"holding(mug_1)": true}`.
    pub state: *const c_char,
    /// Text of further declarations.
    pub domain: *const c_char,
    /// Deadlines and retries can be written; `null` in JSON is the default.
    pub modifiers: bool,
    /// Policies are written in the text syntax; false is JSON.
    pub text: bool,
}

/// A prepared environment.
pub struct MotetEnvironment {
    pub(crate) prepared: AcceptorFactory,
    session: motet_decode::Session,
}

/// Opens and prepares an environment. Null on an error.
///
/// # Safety
///
/// `texts` is null or points to strings as [`MotetEnvironmentTexts`] says.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn motet_environment_new(texts: *const MotetEnvironmentTexts) -> *mut MotetEnvironment {
    guarded(std::ptr::null_mut(), || {
        // SAFETY: as the function's.
        let texts = unsafe { shared(texts, "environment")? };
        // SAFETY: as the function's.
        let text = |at, what| unsafe { string(at, what) };
        let environment = Environment {
            robot: text(texts.robot, "robot")?,
            declarations: text(texts.declarations, "declarations")?,
            scene: text(texts.scene, "scene")?,
            state: text(texts.state, "state")?,
            domain: text(texts.domain, "domain")?,
        };
        let session = environment.session().map_err(|error| error.to_string())?;
        let modifiers = if texts.modifiers { Modifiers::Written } else { Modifiers::Default };
        let syntax = if texts.text { Syntax::Text } else { Syntax::Json };
        let prepared = AcceptorFactory::new(&session, Subset { syntax, modifiers, ..Subset::default() });
        Ok(handle(MotetEnvironment { prepared, session }))
    })
}

/// Frees an environment; null does nothing. Decoders of it stay valid.
///
/// # Safety
///
/// `environment` is null or a live environment, which is not used again.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn motet_environment_free(environment: *mut MotetEnvironment) {
    // SAFETY: as the function's.
    unsafe { free(environment) };
}

/// Checks a whole policy in either syntax: the diagnostics as JSON objects, one a line; empty without any.
/// Freed with [`motet_string_free`](crate::motet_string_free). Null on an error.
///
/// # Safety
///
/// `environment` is null or a live environment; `policy` is null or points to `len` bytes.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn motet_environment_check(
    environment: *const MotetEnvironment,
    policy: *const u8,
    len: usize,
) -> *mut c_char {
    guarded(std::ptr::null_mut(), || {
        // SAFETY: as the function's.
        let environment = unsafe { shared(environment, "environment")? };
        // SAFETY: as the function's.
        let policy = unsafe { slice(policy, len, "policy")? };
        let policy = std::str::from_utf8(policy).map_err(|_| "the policy is no UTF-8".to_owned())?;
        let mut sources = Sources::default();
        let source = Source::new("policy", policy);
        sources.add(source.clone());
        let parsed = motet_syntax::read(&source, FileId(0));
        Ok(string_out(render::json(&environment.session.check(&parsed), &sources)))
    })
}
