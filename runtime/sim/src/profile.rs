//! Profiles: how often and by how much things go wrong by themselves in a simulated world. Each number is
//! data of a TOML file; three are built in.
//!
//! A rate is the probability of one event, such as one grasp. An error is a standard deviation; no error is
//! more than twice as large.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// Built-in profiles: name and text.
const BUILTIN: &[(&str, &str)] = &[
    ("ideal", include_str!("../profiles/ideal.toml")),
    ("typical", include_str!("../profiles/typical.toml")),
    ("harsh", include_str!("../profiles/harsh.toml")),
];

/// Rates and errors of a simulated world. The default is the profile `ideal`, in which each is 0.
///
/// ```
/// use motet_sim::Profile;
///
/// let typical = Profile::builtin("typical").unwrap();
/// let clumsy = Profile::from_toml("[hand]\nslip = 0.5").unwrap();
/// assert!(typical.hand.slip < clumsy.hand.slip);
/// assert_eq!(clumsy.camera, Profile::default().camera);
/// ```
#[derive(Clone, PartialEq, Debug, Default, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub struct Profile {
    pub room: RoomRates,
    pub base: BaseRates,
    pub camera: CameraRates,
    pub hand: HandRates,
    pub people: PeopleRates,
}

/// Differences between the room as it is and as the robot was told.
#[derive(Clone, PartialEq, Debug, Default, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub struct RoomRates {
    /// Error in m of the place of each thing that can be carried.
    #[schemars(range(min = 0.0, max = 0.5))]
    pub shift_m: f64,
    /// Rate of things that stand on another surface.
    #[schemars(range(min = 0.0, max = 1.0))]
    pub misplaced: f64,
}

/// Errors of the base.
#[derive(Clone, PartialEq, Debug, Default, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub struct BaseRates {
    /// Error in m of the place at which a drive ends.
    #[schemars(range(min = 0.0, max = 0.5))]
    pub error_m: f64,
}

/// Errors of cameras and of recognition.
#[derive(Clone, PartialEq, Debug, Default, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub struct CameraRates {
    /// Error in m of a measured place, for each metre to the thing.
    #[schemars(range(min = 0.0, max = 0.5))]
    pub error_per_m: f64,
    /// Rate at which a look misses a thing of 10 cm in full view at 1 m. It grows as the thing looks smaller
    /// and as less of it shows.
    #[schemars(range(min = 0.0, max = 1.0))]
    pub miss: f64,
    /// Rate at which a look takes a thing in view of the same class, category or colour for the right one.
    #[schemars(range(min = 0.0, max = 1.0))]
    pub confuse: f64,
}

/// Errors of the hand.
#[derive(Clone, PartialEq, Debug, Default, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub struct HandRates {
    /// Error in m of the place to which the hand comes.
    #[schemars(range(min = 0.0, max = 0.5))]
    pub error_m: f64,
    /// Rate of grasps out of which the thing slips.
    #[schemars(range(min = 0.0, max = 1.0))]
    pub slip: f64,
    /// Rate of drives on which the hand drops what it carries.
    #[schemars(range(min = 0.0, max = 1.0))]
    pub drop: f64,
    /// Rate of placements that fall short: the thing ends on the floor.
    #[schemars(range(min = 0.0, max = 1.0))]
    pub short: f64,
    /// Rate at which a door or a drawer sticks.
    #[schemars(range(min = 0.0, max = 1.0))]
    pub stick: f64,
    /// Spread of the friction between the fingers and things, as a share of it. Only physics has friction.
    #[schemars(range(min = 0.0, max = 0.9))]
    pub friction: f64,
}

/// Habits of people.
#[derive(Clone, PartialEq, Debug, Default, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub struct PeopleRates {
    /// Rate at which a person refuses an answer or a handed thing.
    #[schemars(range(min = 0.0, max = 1.0))]
    pub refuse: f64,
    /// Rate of late answers.
    #[schemars(range(min = 0.0, max = 1.0))]
    pub late: f64,
    /// Delay of a late answer in s.
    #[schemars(range(min = 0.0, max = 600.0))]
    pub late_secs: f64,
    /// Walks of each person in a minute, up to a metre each.
    #[schemars(range(min = 0.0, max = 10.0))]
    pub walk_per_min: f64,
}

/// Profile that cannot be read.
#[derive(Debug, thiserror::Error)]
#[error("{message}")]
pub struct ProfileError {
    message: String,
}

impl Profile {
    /// Names of the built-in profiles.
    pub fn names() -> impl Iterator<Item = &'static str> {
        BUILTIN.iter().map(|(name, _)| *name)
    }

    /// Built-in profile of a name.
    #[must_use]
    pub fn builtin(name: &str) -> Option<Self> {
        let (_, text) = BUILTIN.iter().find(|(known, _)| *known == name)?;
        Self::from_toml(text).ok()
    }

    /// Reads the text of a profile. Numbers that it leaves out are 0.
    ///
    /// # Errors
    ///
    /// The text is not TOML of this form, or a number is out of its range; with line and column where the
    /// text is at fault.
    pub fn from_toml(text: &str) -> Result<Self, ProfileError> {
        let profile: Self = toml::from_str(text)
            .map_err(|error| ProfileError { message: error.to_string().trim_end().to_owned() })?;
        profile.check()?;
        Ok(profile)
    }

    /// Checks that each number is in its range.
    ///
    /// # Errors
    ///
    /// The first number that is not.
    pub fn check(&self) -> Result<(), ProfileError> {
        self.wrong().map_or(Ok(()), |message| Err(ProfileError { message }))
    }

    /// Describes the first number that is out of its range.
    fn wrong(&self) -> Option<String> {
        let Self { room, base, camera, hand, people } = self;
        let numbers = [
            ("room.shift_m", room.shift_m, 0.5),
            ("room.misplaced", room.misplaced, 1.0),
            ("base.error_m", base.error_m, 0.5),
            ("camera.error_per_m", camera.error_per_m, 0.5),
            ("camera.miss", camera.miss, 1.0),
            ("camera.confuse", camera.confuse, 1.0),
            ("hand.error_m", hand.error_m, 0.5),
            ("hand.slip", hand.slip, 1.0),
            ("hand.drop", hand.drop, 1.0),
            ("hand.short", hand.short, 1.0),
            ("hand.stick", hand.stick, 1.0),
            ("hand.friction", hand.friction, 0.9),
            ("people.refuse", people.refuse, 1.0),
            ("people.late", people.late, 1.0),
            ("people.late_secs", people.late_secs, 600.0),
            ("people.walk_per_min", people.walk_per_min, 10.0),
        ];
        let is_wrong = |(_, number, most): &(&str, f64, f64)| !(0.0..=*most).contains(number);
        let (name, number, most) = numbers.into_iter().find(is_wrong)?;
        Some(format!("`{name}` is {number}, which is not between 0 and {most}"))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn profile_of_each_name_is_read() {
        for name in Profile::names() {
            assert!(Profile::builtin(name).is_some(), "{name}");
        }
        assert_eq!(Profile::builtin("ideal"), Some(Profile::default()));
        assert_eq!(Profile::builtin("perfect"), None);
    }

    #[test]
    fn profile_errors_name_the_number_and_the_place() {
        for (text, why) in [
            ("[hand]\nslip = 1.5", "`hand.slip` is 1.5, which is not between 0 and 1"),
            ("[base]\nerror_m = -0.1", "`base.error_m` is -0.1"),
            ("[camera]\nmiss = nan", "`camera.miss` is NaN"),
            ("[hand]\nslipp = 0.1", "unknown field `slipp`"),
            ("[hand]\nslip = \"often\"", "line 2"),
            ("[hand", "line 1"),
        ] {
            let error = Profile::from_toml(text).map_err(|error| error.to_string());
            assert!(error.as_ref().is_err_and(|said| said.contains(why)), "{text}: {error:?}");
        }
    }
}
