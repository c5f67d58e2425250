//! Rooms of the cases: what there is in each, with its name in speech.

/// A thing or a place, and its name with an article.
pub(super) type Named = (&'static str, &'static str);

/// A room.
pub(super) struct Room {
    pub(super) scene: &'static str,
    /// Things that either robot can carry.
    pub(super) things: &'static [Named],
    /// Surfaces to put things on.
    pub(super) surfaces: &'static [Named],
    /// Containers with doors.
    pub(super) containers: &'static [Named],
    /// Places to go to.
    pub(super) places: &'static [Named],
    /// The bin.
    pub(super) bin: &'static str,
    /// A name that several things have, with one of them and how it is told apart.
    pub(super) shared: (&'static str, &'static str, &'static [&'static str]),
}

pub(super) const ROOMS: &[Room] = &[
    Room {
        scene: "kitchen",
        things: &[
            ("coke", "the coke can"),
            ("apple", "the green apple"),
            ("mug_1", "the red mug"),
            ("bottle", "the water bottle"),
            ("sponge", "the sponge"),
        ],
        surfaces: &[("kitchen_table", "the kitchen table"), ("counter", "the counter"), ("sink", "the sink")],
        containers: &[
            ("drawer_1", "the top drawer"),
            ("cupboard_1", "the cupboard"),
            ("fridge_1", "the fridge"),
        ],
        places: &[
            ("kitchen_table", "the kitchen table"),
            ("sink", "the sink"),
            ("door", "the kitchen door"),
            ("charging_dock", "the charging station"),
        ],
        bin: "trash",
        shared: ("the mug", "mug_1", &["the red one", "the red mug", "the one on the table"]),
    },
    Room {
        scene: "living_room",
        things: &[
            ("remote_1", "the remote control"),
            ("magazine", "the magazine"),
            ("cup", "the tea cup"),
            ("bottle_1", "the water bottle"),
        ],
        surfaces: &[("coffee_table", "the coffee table"), ("cabinet", "the sideboard")],
        containers: &[("drawer_1", "the drawer")],
        places: &[
            ("sofa", "the sofa"),
            ("bookshelf", "the bookshelf"),
            ("window", "the window"),
            ("door", "the door"),
        ],
        bin: "trash_bin",
        shared: ("the toy", "toy", &["the toy car", "the car", "the one on the coffee table"]),
    },
];
