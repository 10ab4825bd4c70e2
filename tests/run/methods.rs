//! The list of methods that a firmware is built from, against what the host builds by name.

use std::any::type_name;
use std::collections::BTreeSet;

use stillbeam_golden::methods::{self, Visitor, visit_all};
use stillbeam_sim::dispatch;
use stillbeam_sim::scene_file::SceneFile;
use stillbeam_sim::solver::{Mass, Method, Quality, SolverKeys};

struct Compare {
    scene: SceneFile,
    /// The ids that the host builds alike.
    same: BTreeSet<&'static str>,
    families: BTreeSet<&'static str>,
}

impl Visitor for Compare {
    fn visit<M: methods::Method>(&mut self) {
        // Newmark's rule in nodal coordinates, for comparison: the host offers the faster form.
        if M::QUALITY == "nodal" || !M::fits(&self.scene.arm) {
            return;
        }
        let typed = format!("{}: {} {} {} {}", M::ID, M::METHOD, M::SIZE, M::QUALITY, M::SKIP);
        let method = Method::ALL.iter().copied().find(|method| method.name() == M::METHOD);
        let method = method.unwrap_or_else(|| panic!("{typed}: no method of scene files"));
        let size = Some(i64::from(M::SIZE));
        let keys = SolverKeys {
            method: Some(method),
            elements: size.filter(|_| method == Method::Newmark),
            modes: size
                .filter(|_| matches!(method, Method::Modal | Method::Elastica | Method::Pointwise)),
            mass: Mass::ALL.iter().copied().find(|mass| mass.name() == M::QUALITY),
            quality: Quality::ALL.iter().copied().find(|quality| quality.name() == M::QUALITY),
            spin: (M::SKIP == "no-spin").then_some(false),
            ..SolverKeys::default()
        };
        assert_eq!(keys.unread(method), [""; 0], "{typed}");
        let solver = keys.resolve().unwrap_or_else(|error| panic!("{typed}: {error}"));
        let built = dispatch::stepper(&self.scene, &solver);
        let built = built.unwrap_or_else(|error| panic!("{typed}: {error}"));
        assert_eq!(built.type_name(), type_name::<M::Stepper>(), "{typed}");
        self.same.insert(M::ID);
        self.families.insert(M::METHOD);
    }
}

/// Every method of the list has a name in scene files, which builds the same type of stepper; and
/// every name but `auto`, which chooses one, has a method in the list.
#[test]
fn scene_files_name_what_a_firmware_is_built_from() {
    let mut same = BTreeSet::new();
    let mut families = BTreeSet::new();
    for inertia in ["0.0", "1e-5"] {
        let text = format!(
            "[link]\nlength = 0.4\nmass = 0.0224\nbending_stiffness = 0.46\n[payload]\nmass = 0.03\n\
             inertia = {inertia}\n[move]\nprofile = \"cubic\"\nduration = 1.0\nto = 1.0\n"
        );
        let scene = SceneFile::parse("test", &text).expect("a scene");
        let mut compare = Compare { scene, same: BTreeSet::new(), families: BTreeSet::new() };
        visit_all(&mut compare);
        same.extend(compare.same);
        families.extend(compare.families);
    }
    struct Ids(BTreeSet<&'static str>);
    impl Visitor for Ids {
        fn visit<M: methods::Method>(&mut self) {
            self.0.insert(M::ID);
        }
    }
    let mut listed = Ids(BTreeSet::new());
    visit_all(&mut listed);
    let left: Vec<_> = listed.0.difference(&same).collect();
    assert_eq!(left, [&"Newmark1Nodal"]);
    let typed = Method::ALL.iter().filter(|&&method| method != Method::Auto);
    assert_eq!(families, typed.map(|method| method.name()).collect());
}
