//! Robots by name: built in, or a folder of the user's own with a `robot.toml`.

use std::fs::{self, File};
use std::io::Read;
use std::path::{Path, PathBuf};

use motet_geometry::kinematics::{Dof, quasi_random};
use motet_geometry::planning::{
    AllowedCollisions, Configuration, HandModel, MIN_CLEARANCE, QueryContext, RobotModel, SceneState,
};
use motet_robots::builtin;
use motet_robots::card::{self, DraftStance, ModelFile, ModelSpec, Robot};
use motet_robots::mesh::{self, MeshFile};
use motet_robots::scene::Scene;
use motet_robots::srdf;
use motet_robots::urdf::{self, Urdf};
use motet_syntax::{Sources, suggest};

use crate::error::{DiagnosticSink, ProjectError, invalid, require};
use crate::files::{add_source, is_inline, read_optional, read_small};

/// Files of one robot: its card, its declarations, and the folder with its URDF, SRDF and meshes.
#[derive(Clone, Debug)]
pub struct RobotFiles {
    /// Name of the card in diagnostics.
    pub(crate) name: String,
    pub(crate) home: Home,
    /// Text of `robot.toml`.
    pub(crate) toml: Vec<u8>,
    /// Text of `primitives.motet`.
    declarations: Option<String>,
}

/// Location of the files that a card names.
#[derive(Clone, Debug)]
pub(crate) enum Home {
    /// In this binary, under the robot's name.
    BuiltIn(&'static str),
    Folder(PathBuf),
}

/// Names of the built-in robots.
///
/// ```
/// assert!(motet_project::robot_names().any(|name| name == "hsr"));
/// ```
pub fn robot_names() -> impl Iterator<Item = &'static str> {
    builtin::ROBOTS.iter().map(|robot| robot.name)
}

impl RobotFiles {
    /// Files of a built-in robot.
    #[must_use]
    pub fn built_in(name: &str) -> Option<Self> {
        builtin::robot_texts(name).map(|texts| Self {
            name: format!("{name}/robot.toml"),
            home: Home::BuiltIn(texts.name),
            toml: texts.card.as_bytes().to_vec(),
            declarations: texts.declarations.map(Into::into),
        })
    }

    /// Finds a robot by a built-in name, by its folder, or by the path of its `robot.toml`; or takes the
    /// content of a `robot.toml` as a JSON object, whose files are in its `folder`, or else in the present
    /// one.
    ///
    /// ```
    /// use motet_project::RobotFiles;
    ///
    /// let json = r#"{"name": "cart", "base": {"drive": "legged"}}"#;
    /// let card = RobotFiles::find(json)?.texts().0;
    /// assert!(card.contains("name = \"cart\""));
    /// assert!(RobotFiles::find("{nonsense").is_err());
    /// # Ok::<(), motet_project::ProjectError>(())
    /// ```
    ///
    /// # Errors
    ///
    /// There is no such robot, or its files cannot be read.
    pub fn find(name: &str) -> Result<Self, ProjectError> {
        if let Some(files) = Self::built_in(name) {
            return Ok(files);
        }
        if is_inline(name) {
            return Self::of_json(name);
        }
        let path = Path::new(name);
        if path.is_dir() {
            return Self::in_folder(path);
        }
        if path.file_name().is_some_and(|file| file == "robot.toml") && path.is_file() {
            return Self::in_folder(path.parent().unwrap_or(Path::new(".")));
        }
        let near = suggest::closest(name, robot_names()).map(|near| format!("did you mean `{near}`? "));
        let help = format!(
            "{}built-in robots: {}; your own robot is a folder with a robot.toml",
            near.unwrap_or_default(),
            suggest::one_of(robot_names())
        );
        Err(ProjectError::Unknown { what: "robot", name: name.to_owned(), help })
    }

    /// Card as JSON: TOML is what diagnostics and journals show.
    fn of_json(json: &str) -> Result<Self, ProjectError> {
        let wrong = |why: String| ProjectError::Card(why);
        let mut card: toml::Table = serde_json::from_str(json).map_err(|error| wrong(error.to_string()))?;
        let folder = match card.remove("folder") {
            None => None,
            Some(toml::Value::String(folder)) => Some(PathBuf::from(folder)),
            Some(other) => return Err(wrong(format!("`folder` is a path, not `{other}`"))),
        };
        let toml = toml::to_string(&card).map_err(|error| wrong(error.to_string()))?;
        let mut files = Self::draft(folder.as_deref().unwrap_or(Path::new(".")), &toml);
        files.declarations = folder.as_deref().map(declarations_in).transpose()?.flatten();
        Ok(files)
    }

    /// Text of the card and of its declarations.
    #[must_use]
    pub fn texts(&self) -> (String, Option<String>) {
        (String::from_utf8_lossy(&self.toml).into_owned(), self.declarations.clone())
    }

    /// Card that is not written yet, in the folder where it will be.
    #[must_use]
    pub fn draft(folder: &Path, toml: &str) -> Self {
        Self {
            name: folder.join("robot.toml").display().to_string(),
            home: Home::Folder(folder.to_owned()),
            toml: toml.as_bytes().to_vec(),
            declarations: None,
        }
    }

    fn in_folder(folder: &Path) -> Result<Self, ProjectError> {
        let path = folder.join("robot.toml");
        if !path.is_file() {
            return Err(ProjectError::NoCard { path: folder.to_owned() });
        }
        let declarations = declarations_in(folder)?;
        let home = Home::Folder(folder.to_owned());
        Ok(Self { name: path.display().to_string(), home, toml: read_small(&path)?, declarations })
    }

    /// Reads the card and its declarations.
    ///
    /// # Errors
    ///
    /// [`ProjectError::Invalid`] if the card has errors.
    pub fn card(&self, sources: &mut Sources, sink: &mut dyn DiagnosticSink) -> Result<Robot, ProjectError> {
        let (source, file, mut diagnostics) = add_source(&self.name, &self.toml, sources);
        let (robot, more) = card::read(&source, file, self.declarations.as_deref());
        diagnostics.extend(more);
        require("robot card", &diagnostics, sources, sink)?;
        robot.ok_or_else(|| invalid("robot card", diagnostics, sources))
    }
}

/// Text of the declarations beside a card, if it has any.
fn declarations_in(folder: &Path) -> Result<Option<String>, ProjectError> {
    let path = folder.join("primitives.motet");
    if !path.exists() {
        return Ok(None);
    }
    String::from_utf8(read_small(&path)?).map(Some).map_err(|_| ProjectError::NotText { path })
}

impl RobotFiles {
    /// Reads the URDF that the card names, with solids for its meshes and with the pairs of links that the
    /// SRDF allows to touch. `None` if the card names no URDF.
    ///
    /// # Errors
    ///
    /// A file cannot be read, has errors, or does not fit the card.
    pub fn body(
        &self,
        robot: &Robot,
        sources: &mut Sources,
        sink: &mut dyn DiagnosticSink,
    ) -> Result<Option<Urdf>, ProjectError> {
        let Some(model) = &robot.model else { return Ok(None) };
        let (toml, toml_id, _) = add_source(&self.name, &self.toml, sources);
        let missing = |which| card::missing(&toml, toml_id, which);
        let Some((name, bytes)) = self.urdf(model)? else {
            let found = missing(ModelFile::Urdf);
            require("robot card", found.as_slice(), sources, sink)?;
            return Err(invalid("robot card", found.into_iter().collect(), sources));
        };
        let (source, file, mut diagnostics) = add_source(&name, &bytes, sources);
        let (urdf, more) = urdf::read(&source, file);
        diagnostics.extend(more);
        require("URDF", &diagnostics, sources, sink)?;
        let Some(urdf) = urdf else { return Err(invalid("URDF", diagnostics, sources)) };
        // The remaining files are read even so: one pass reports all that is wrong with them.
        let fits = require("robot card", &card::fit(&toml, toml_id, &urdf), sources, sink);
        self.missing_packages(model, |at| sink.report(missing(ModelFile::Package(at)).as_slice(), sources));
        let folders = self.mesh_folders(model);
        let (mut urdf, found) = mesh::attach(&source, file, urdf, |name| folders.find(name));
        let meshes = require("URDF", &found, sources, sink);
        match self.srdf(model)? {
            Srdf::None => {}
            Srdf::Missing => require("robot card", missing(ModelFile::Srdf).as_slice(), sources, sink)?,
            Srdf::Text(name, bytes) => {
                let (source, file, mut diagnostics) = add_source(&name, &bytes, sources);
                let (srdf, more) = srdf::read(&source, file, &urdf);
                diagnostics.extend(more);
                require("SRDF", &diagnostics, sources, sink)?;
                urdf.may_touch = srdf.map(|srdf| srdf.disabled).unwrap_or_default();
            }
        }
        fits.and(meshes).map(|()| Some(urdf))
    }

    /// Name and content of the URDF; `None` if it does not exist.
    fn urdf(&self, model: &ModelSpec) -> Result<Option<(String, Vec<u8>)>, ProjectError> {
        match &self.home {
            Home::BuiltIn(name) => {
                let text = builtin::robot_texts(name).map_or("", |texts| texts.urdf);
                Ok(Some((format!("{name}/{}", model.urdf), text.as_bytes().to_vec())))
            }
            Home::Folder(_) => self.read_inside(model, &model.urdf),
        }
    }

    /// Reads a file that the card names, which must be in its folder or in one of its packages: a card of
    /// somebody else shows no other file. `None` if it does not exist.
    fn read_inside(&self, model: &ModelSpec, file: &str) -> Result<Option<(String, Vec<u8>)>, ProjectError> {
        let Home::Folder(folder) = &self.home else { return Ok(None) };
        let path = folder.join(file);
        match fs::canonicalize(&path) {
            Ok(found) if !is_inside(&found, &allowed(folder, model)) => Err(ProjectError::Outside { path }),
            Ok(_) | Err(_) => read_optional(&path),
        }
    }

    fn srdf(&self, model: &ModelSpec) -> Result<Srdf, ProjectError> {
        let (Home::Folder(_), Some(file)) = (&self.home, &model.srdf) else { return Ok(Srdf::None) };
        Ok(self.read_inside(model, file)?.map_or(Srdf::Missing, |(name, bytes)| Srdf::Text(name, bytes)))
    }

    /// Passes the index of each package folder that does not exist.
    fn missing_packages(&self, model: &ModelSpec, mut each: impl FnMut(usize)) {
        let Home::Folder(folder) = &self.home else { return };
        for (package, at) in model.packages.iter().zip(0..) {
            if !folder.join(package).is_dir() {
                each(at);
            }
        }
    }

    fn mesh_folders(&self, model: &ModelSpec) -> MeshFolders {
        let Home::Folder(folder) = &self.home else { return MeshFolders::default() };
        let urdf = folder.join(&model.urdf);
        let own = urdf.parent().unwrap_or(folder).to_owned();
        let text = |path: PathBuf| path.display().to_string();
        let packages = model.packages.iter().map(|package| text(folder.join(package))).collect();
        MeshFolders { own: text(own), packages, allowed: allowed(folder, model) }
    }
}

/// Canonical folders below which the files of a card must be, so that no link leads out of them: its own, and
/// those of its packages. The folder of the URDF is below one of them.
fn allowed(folder: &Path, model: &ModelSpec) -> Vec<PathBuf> {
    let packages = model.packages.iter().map(|package| folder.join(package));
    let folders = [folder.to_owned()].into_iter().chain(packages);
    folders.filter_map(|folder| fs::canonicalize(folder).ok()).collect()
}

fn is_inside(path: &Path, folders: &[PathBuf]) -> bool {
    folders.iter().any(|folder| path.starts_with(folder))
}

enum Srdf {
    None,
    Missing,
    Text(String, Vec<u8>),
}

/// Folders in which the meshes of a URDF are searched.
#[derive(Default)]
struct MeshFolders {
    /// Folder of the URDF.
    own: String,
    /// Package folders, in the order of the card.
    packages: Vec<String>,
    /// Canonical folders below which a mesh must be.
    allowed: Vec<PathBuf>,
}

impl MeshFolders {
    fn find(&self, name: &str) -> MeshFile {
        let looked = mesh::locate(name, &self.own, &self.packages);
        let mut there: Vec<PathBuf> = looked.iter().filter_map(|path| fs::canonicalize(path).ok()).collect();
        // Files first.
        there.sort_by_key(|path| !path.is_file());
        let Some(path) = there.first() else {
            // `locate` gives no candidate for a name that leaves its package.
            let leaves = looked.is_empty() && name.split('/').any(|part| part == "..");
            return if leaves { MeshFile::Outside } else { MeshFile::Missing(looked) };
        };
        if !is_inside(path, &self.allowed) {
            return MeshFile::Outside;
        }
        if !path.is_file() {
            return MeshFile::NotAFile;
        }
        let mut bytes = Vec::new();
        // One byte above the limit shows that the file is too large.
        let read = File::open(path).and_then(|file| file.take(mesh::MAX_BYTES + 1).read_to_end(&mut bytes));
        match read {
            Ok(_) if bytes.len() as u64 > mesh::MAX_BYTES => MeshFile::TooLarge,
            Ok(_) => MeshFile::Bytes(bytes),
            Err(_) => MeshFile::Missing(looked),
        }
    }
}

/// Maximum number of postures that are tried besides the one with every joint at 0.
const POSTURES: usize = 256;

/// Finds the stance of a robot whose card has none.
#[must_use]
pub fn find_stance(robot: &Robot, urdf: &Urdf) -> DraftStance {
    let machine = RobotModel::new(robot, urdf);
    let is_arm = |hand: &HandModel, link: usize| hand.carried.get(link) == Some(&true);
    if machine.drives() {
        let stands = |link: usize| !machine.hand().is_some_and(|hand| is_arm(hand, link));
        let height = above(&machine, stands, 0.0);
        let raised = (height > 0.0).then(|| raised(robot, urdf, height));
        return posture(raised.as_ref().unwrap_or(&machine), height).0;
    }
    let (stance, against) = posture(&machine, 0.0);
    // What is bolted down is on the floor, unless a shape of the arm then is below it wherever its joints
    // are.
    let height =
        if against == Some(Against::Floor) { above(&machine, |_| true, MIN_CLEARANCE + 1e-3) } else { 0.0 };
    let above = (height > 0.0).then(|| posture(&raised(robot, urdf, height), height).0);
    above.filter(|above| above.touch.is_none()).unwrap_or(stance)
}

/// Robot model with its base link raised to `height_m` above the floor.
fn raised(robot: &Robot, urdf: &Urdf, height_m: f64) -> RobotModel {
    let mut robot = robot.clone();
    if let Some(model) = &mut robot.model {
        model.height_m = height_m;
    }
    RobotModel::new(&robot, urdf)
}

/// Other side of a contact.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Against {
    Itself,
    Floor,
}

/// The first posture of the arm in which nothing touches, at a height; where there is none, what the robot
/// touches in the first that was tried.
fn posture(machine: &RobotModel, height_m: f64) -> (DraftStance, Option<Against>) {
    let scene = Scene::default();
    let world = SceneState::new(machine, &scene);
    let room = QueryContext::new(machine, &scene, &world);
    let touch = |joints: &[f64]| {
        let state = Configuration { base: [0.0; 3], joints: joints.to_vec() };
        room.contact(&state, AllowedCollisions::default())
    };
    let Some(first) = touch(machine.rest()) else {
        return (DraftStance { height_m, ..DraftStance::default() }, None);
    };
    let found = machine.hand().and_then(|hand| {
        let chain = hand.solver.chain();
        (0..POSTURES).map(|index| written(&chain.dofs, index)).find(|values| {
            let mut joints = machine.rest().to_vec();
            for (at, value) in chain.in_tree.iter().zip(values) {
                if let Some(slot) = joints.get_mut(*at) {
                    *slot = *value;
                }
            }
            touch(&joints).is_none()
        })
    });
    let dofs = machine.hand().map(|hand| hand.solver.chain().dofs.as_slice()).unwrap_or_default();
    // In a room without a thing, what is not the robot's own is the floor.
    let against = if first.is_own { Against::Itself } else { Against::Floor };
    let against = found.is_none().then_some(against);
    let touch = against.map(|_| [first.link, first.other]);
    let joints = dofs.iter().map(|dof| dof.name.clone()).zip(found.into_iter().flatten());
    (DraftStance { height_m, joints: joints.collect(), touch }, against)
}

/// Height of the base link above the floor, in m and rounded up to a millimetre, with which the chosen links
/// clear the floor by `gap`; 0 if the base link may be on the floor.
fn above(machine: &RobotModel, counts: impl Fn(usize) -> bool, gap: f64) -> f64 {
    let state = Configuration { base: [0.0; 3], joints: machine.rest().to_vec() };
    let below = machine.lowest(&state, counts).map_or(0.0, |(_, height)| gap - height);
    // Less than a hundredth of a millimetre is rounding.
    if below > 1e-5 { ((below - 1e-5) * 1e3).ceil() / 1e3 } else { 0.0 }
}

/// Posture number `index`, rounded to three digits as in a card: the middle of the limits, then a Halton
/// sequence over them.
fn written(dofs: &[Dof], index: usize) -> Vec<f64> {
    let values = quasi_random(dofs, index).into_iter().zip(dofs).map(|(value, dof)| {
        let value = (value * 1e3).round() / 1e3;
        dof.limits.map_or(value, |(lower, upper)| value.clamp(lower, upper))
    });
    values.collect()
}
