//! Keys of a case: how it is solved, what is asked of it, and what is known of the result.

use super::form::{
    ABOVE_ZERO, ANY, EitherForm, IN_PLANE, KeyForm, ListForm, MOST, NUMBER, NamedForm, NumberRange, POINT, TableForm, TableRule,
    VECTOR, ValueForm, key, list, named, set,
};

pub static SOLVER: TableForm = TableForm {
    name: "solver",
    sentence: "",
    keys: &[&[
        key("name", ValueForm::Word(&["auto", "fieldsplit", "direct"]), "`\"fieldsplit\"`: GMRES with multigrid (BiCGStab above half a million unknowns); where there is one small level only, as with P1 and `refine = 0`, with a Cholesky factor. `\"direct\"`: MUMPS on the plain system. `\"auto\"`: fieldsplit; without levels (`refine = 0`) and up to 3000 unknowns with a Cholesky factor of K + BᵀDB in the place of multigrid. The run says which, and why.")
            .or("\"auto\""),
        key(
            "tolerance",
            ValueForm::Either(&EitherForm {
                of: &[
                    ValueForm::Word(&["discretisation"]),
                    ValueForm::Number(NumberRange {
                        least: Some(1e-16),
                        most: Some(1e-2),
                        words: "must lie in [1e-16, 0.01]; 1e-8 is the default",
                        ..ANY
                    }),
                ],
                wanted: "a number like 1e-8, or \"discretisation\"",
            }),
            "Relative residual; see [method.md](method.md). `\"discretisation\"`: until the algebraic error is a tenth of the discretisation error, in λ too.",
        )
        .or("1e-8"),
        key(
            "inf_sup",
            ValueForm::Either(&EitherForm { of: &[ValueForm::Word(&["auto"]), ValueForm::Boolean], wanted: "\"auto\", true or false" }),
            "Whether the inf-sup constants are computed (a factorisation); `\"auto\"`: up to 10 000 unknowns, and up to 200 000 after a solve that failed or whose active set was found by rising energy.",
        )
        .or("\"auto\""),
    ]],
    rules: &[],
    inline: false,
};

pub static PROBE: TableForm = TableForm {
    name: "probe",
    sentence: "Displacement and stress at a point, in `summary.json`.",
    keys: &[&[
        key("point", POINT, "The point, `[1.0, 2.0]`.").required("[1.0, 2.0]").unit("length"),
        key(
            "body",
            ValueForm::Name,
            "Name of a body, or of a part: between two parts, where the stress jumps, it must be one of these.",
        )
        .required("\"lower\""),
    ]],
    rules: &[],
    inline: false,
};

/// A relative error: below 1e-8 rounding begins; above 0.5 an error says nothing.
pub const TOLERANCE: ValueForm = ValueForm::Number(NumberRange {
    least: Some(1e-8),
    most: Some(0.5),
    words: "must be a number from 1e-8 to 0.5, the relative error that is asked for",
    ..ANY
});

/// A relative error that the mesh is adapted to.
const fn goal(name: &'static str, sentence: &'static str) -> KeyForm {
    key(name, TOLERANCE, sentence).refused("must be a number from 1e-8 to 0.5, the relative error that is asked for")
}

/// Goals that a contact may have.
const OF_CONTACTS: &[KeyForm] = &[
    goal("force", "Of ∫λ ds."),
    goal(
        "pressure",
        "Of λ in the mean square over the middle 60 % of each zone that presses and counts (`lambda` in `summary.json`).",
    ),
    goal("peak", "Of the largest λ (`pressure_max`), which is never reached where λ grows without bound."),
    goal("ends", "Of the ends of contact, by its width; of unilateral contacts only."),
];

pub static ACCURACY: TableForm = TableForm {
    name: "accuracy",
    sentence: "Relative errors that the mesh is adapted to, see [accuracy](#accuracy); at least one. `force`, `pressure`, `peak` and `ends` are of every contact, `displacement` and `stress` at every `[probe]`, by their own size.",
    keys: &[
        &[goal("energy", "Of the displacement in the energy norm.")],
        OF_CONTACTS,
        &[
            goal("displacement", "Of the displacement at every `[probe]`."),
            goal("stress", "Of the stress at every `[probe]`."),
            key("max_unknowns", ValueForm::Whole([100, MOST]), "Displacement unknowns of the finest mesh, at most; a mesh file that has more alone is refused.")
                .or_else("half of the memory that is left to all ranks: what each machine has, what cgroups (batch jobs, containers) and `ulimit -v` leave of it, shared by the ranks there")
                .refused("must be a whole number of at least 100, such as 100000"),
            key("max_seconds", ABOVE_ZERO, "After so many seconds no further mesh is begun.").or_else("none").unit("seconds"),
            key("contact", named(&ONE_CONTACT), ""),
        ],
    ],
    rules: &[TableRule::OneOf(&[
        &["energy"],
        &["force"],
        &["pressure"],
        &["peak"],
        &["ends"],
        &["displacement"],
        &["stress"],
        &["contact"],
    ])],
    inline: false,
};

static ONE_CONTACT: TableForm = TableForm {
    name: "accuracy-of-contact",
    sentence: "Of one contact, instead of those of all or beside them.",
    keys: &[OF_CONTACTS],
    rules: &[TableRule::OneOf(&[&["force"], &["pressure"], &["peak"], &["ends"]])],
    inline: false,
};

pub static STEPS: TableForm = TableForm {
    name: "steps",
    sentence: "A factor that changes from load step to load step, see [load steps](#load-steps); several of them change together.",
    keys: &[&[
        key(
            "factors",
            ValueForm::List(&ListForm { count: [1, 1000], noun: "steps", ..list(NUMBER, "a list of numbers") }),
            "One number for each step, `[0.25, 0.5, 1]`; all lists are equally long.",
        )
        .required("[0.5, 1.0], one for each step"),
        key(
            "scales",
            ValueForm::List(&set(
                ValueForm::Name,
                "keys of loads, supports, rigid tools, contacts or bodies, as in [\"load.top\", \"contact.seam.gap\"]",
            )),
            "What is multiplied by it: keys of tables, `[\"load.top\", \"rigid.die\", \"contact.seam.gap\", \"gravity\"]`, or of single values, `[\"rigid.die.uy\"]`.",
        )
        .required("[\"load.top\"]"),
    ]],
    rules: &[],
    inline: false,
};

pub static OUTPUT: TableForm = TableForm {
    name: "output",
    sentence: "",
    keys: &[&[key("fields", ValueForm::Boolean, "`false`: no fields, no figures and no report, only `summary.json`, `case.toml`, `contacts.csv`, `contact_NAME.csv`, and `steps.csv` of load steps; for many runs, or very large ones.")
        .or("true")]],
    rules: &[],
    inline: false,
};

pub static EXACT: TableForm = TableForm {
    name: "exact",
    sentence: "Values that you expect; relative errors go to `summary.json`.",
    keys: &[&[
        key("must_hold", ValueForm::Boolean, "`true`: a miss is exit code 3.").or("false"),
        key(
            "energy",
            ValueForm::Table(&EXPECTED),
            "`{ value, tolerance }` of the total strain energy, [`energy.stationary`](method.md#energy-and-balance) where there is one.",
        ),
        key("contact", named(&EXACT_CONTACT), ""),
        key("body", ValueForm::Named(NamedForm { table: &EXACT_BODY, placeholder: "NAME", least: 0, in_files: false }), ""),
    ]],
    rules: &[],
    inline: false,
};

const WITHIN: KeyForm = key("tolerance", ABOVE_ZERO, "How far off the value may be, as a fraction of it.").required("1e-3");

static EXPECTED: TableForm = TableForm {
    name: "expected",
    sentence: "",
    keys: &[&[
        key(
            "value",
            ValueForm::Number(NumberRange { zero: false, words: "must not be 0: the error is relative to it", ..ANY }),
            "The value.",
        )
        .required("1.5"),
        WITHIN,
    ]],
    rules: &[],
    inline: true,
};

static EXACT_CONTACT: TableForm = TableForm {
    name: "exact-of-contact",
    sentence: "",
    keys: &[&[
        key("force", ValueForm::Table(&EXPECTED), "`{ value, tolerance }` of ∫λ ds."),
        key(
            "lambda",
            ValueForm::Table(&LAMBDA),
            "`{ at = [[x, y], ...], value = [...], tolerance }`; at a jump the mean of both values. Points lie at the two boundaries, or between them; no value is 0, for errors are relative. Or `{ formula = \"...\", tolerance }`: L2 error; a formula without a value on Γ_C is an error, or a miss where Γ_C follows the solution.",
        ),
    ]],
    rules: &[],
    inline: false,
};

/// Points where something is known.
const AT: KeyForm = key(
    "at",
    ValueForm::List(&ListForm { count: [1, usize::MAX], ..list(POINT, "a list of points [[x, y], ...]") }),
    "The points.",
)
.like("[[1.2, 3.2]], points on the body")
.unit("length");

const NO_ZERO: ValueForm = ValueForm::Number(NumberRange {
    zero: false,
    words: "must not be 0: the error is relative to each value; leave that point out",
    ..ANY
});

static LAMBDA: TableForm = TableForm {
    name: "exact-lambda",
    sentence: "",
    keys: &[&[
        AT,
        key(
            "value",
            ValueForm::List(&ListForm { count: [1, usize::MAX], ..list(NO_ZERO, "a list of numbers") }),
            "The values, one for each point.",
        )
        .like("[0.925057], or a formula"),
        key("formula", IN_PLANE, "Instead: λ as a formula.").like("\"1 - x^2\""),
        WITHIN,
    ]],
    rules: &[TableRule::OneOf(&[&["formula"], &["at", "value"]]), TableRule::Alone("formula", &["at", "value"])],
    inline: true,
};

static EXACT_BODY: TableForm = TableForm {
    name: "exact-of-body",
    sentence: "",
    keys: &[&[
        key(
            "displacement",
            ValueForm::Table(&DISPLACEMENT),
            "`{ at, value = [[ux, uy], ...], tolerance }`, relative to the largest displacement.",
        ),
        key(
            "u",
            VECTOR,
            "`[\"ux\", \"uy\"]`, formulas: errors in the mean square of the nodes, reported only. What is 0 all over, or has no value at a vertex, is an error.",
        ),
        key(
            "stress",
            ValueForm::List(&ListForm { count: [3, 4], ..list(IN_PLANE, "a list of 3 or 4 numbers or formulas of x, y") }),
            "`[\"xx\", \"yy\", \"xy\"]`, and `\"zz\"`, the hoop stress, of bodies of revolution; formulas: errors in the energy norm, reported only. What is 0 all over, or has no value at a vertex, is an error.",
        ),
    ]],
    rules: &[],
    inline: false,
};

static DISPLACEMENT: TableForm = TableForm {
    name: "exact-displacement",
    sentence: "",
    keys: &[&[
        AT,
        key(
            "value",
            ValueForm::List(&ListForm { count: [1, usize::MAX], ..list(POINT, "a list of points [[x, y], ...]") }),
            "The displacements, one for each point.",
        )
        .like("[[1e-4, -2e-4]]")
        .unit("length"),
        WITHIN,
    ]],
    rules: &[TableRule::OneOf(&[&["at", "value"]])],
    inline: true,
};
