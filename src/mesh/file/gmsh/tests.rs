use super::*;

const SQUARE: &str = "$MeshFormat
4.1 0 8
$EndMeshFormat
$PhysicalNames
2
1 7 \"lower edge\"
2 8 \"plate\"
$EndPhysicalNames
$Entities
0 1 1 0
5 0 0 0 1 0 0 1 7 0
6 0 0 0 1 1 0 1 8 0
$EndEntities
$Nodes
1 5 10 14
2 6 0 5
10
11
12
13
14
0 0 0
1 0 0
1 1 0
0 1 0
9 9 0
$EndNodes
$Elements
2 3 1 3
1 5 1 1
1 10 11
2 6 2 2
2 10 11 12
3 10 13 12
$EndElements
";

/// The same in format 2.2; its triangles are repeated in a second group where a test asks for it.
const SQUARE_2: &str = "$MeshFormat
2.2 0 8
$EndMeshFormat
$PhysicalNames
3
1 7 \"lower edge\"
2 8 \"plate\"
2 9 \"again\"
$EndPhysicalNames
$Nodes
5
10 0 0 0
11 1 0 0
12 1 1 0
13 0 1 0
14 9 9 0
$EndNodes
$Elements
4
1 15 2 0 1 14
2 1 2 7 5 10 11
3 2 2 8 6 10 11 12
4 2 2 8 6 10 13 12
$EndElements
";

fn read_square(text: &str) -> Result<MacroMesh, String> {
    parse_gmsh(text.as_bytes(), Path::new("square.msh"), Default::default()).map_err(|error| error.to_string())
}

#[test]
fn names_nodes_and_triangles_are_read_and_clockwise_ones_turned() {
    for text in [SQUARE, SQUARE_2] {
        let mesh = read_square(text).expect("a good file");
        assert_eq!(mesh.bodies, ["plate"]);
        assert_eq!(mesh.boundary("lower edge").expect("named").edges.len(), 1);
        assert_eq!((mesh.vertices.len(), mesh.triangles.len(), mesh.edges.len()), (4, 2, 5), "the loose node is dropped");
        for triangle in &mesh.triangles {
            let [a, b, c] = triangle.vertices.map(|v| mesh.vertices[v as usize]);
            assert!(crate::geometry::cross(b - a, c - a) > 0.0);
        }
    }
}

#[test]
fn what_cannot_be_read_is_refused_with_line_and_remedy() {
    let table = [
        ("4.1 0 8", "4 0 8", "line 2: mesh format 4 is not read, only 2.2 and 4.1; convert it with `gmsh square.msh"),
        ("4.1 0 8", "4.1 1 4", "line 2: expected `4.1 0 8` for ASCII or `4.1 1 8` for binary, found `4.1 1 4`"),
        ("4.1 0 8", "4.1 1 8", "line 2: the order of bytes of this binary file is not known"),
        ("4.1 0 8", "2.2 0 8", "line 16: node 2 has z = 5"),
        ("2 6 2 2", "2 6 3 2", "in $Elements, expected 5 numbers"),
        ("2 6 2 2", "2 6 4 2", "mesh the plane scene with `gmsh -2`"),
        ("2 6 2 2", "2 6 21 2", "`gmsh -2 -order 2`"),
        ("3 10 13 12", "3 10 13 99", "line 34: node 99 is not among the $Nodes"),
        ("0 1 0\n9", "0 1\n9", "expected 3 numbers, found `0 1`"),
        ("1 1 0\n0 1 0", "1 0 0\n0 1 0", "degenerate triangle"),
        ("1 1 0\n0", "1 1 0.5\n0", "plane z = 0"),
        ("5 0 0 0 1 0 0 1 7 0", "5.5 0 0 0 1 0 0 1 7 0", "line 11: in $Entities, found 5.5 where a tag"),
        ("5 0 0 0 1 0 0 1 7 0", "5 0 0 0 1 0 0 1e300 7 0", "found 1e300 where"),
        ("5 0 0 0 1 0 0 1 7 0", "5 0 0 0 1 0 0 9 7 0", "expected 9 physical tags, found 2 numbers"),
        ("1 10 11\n", "1 11 13\n", "\"lower edge\" is not an edge of a triangle"),
        ("1 10 11\n", "1 10 12\n", "\"lower edge\" lies inside a body"),
        ("$Entities", "$PartitionedEntities", "is partitioned; save it whole"),
    ];
    for (good, bad, words) in table {
        let found = read_square(&SQUARE.replacen(good, bad, 1)).expect_err(words);
        assert!(found.contains(words), "{found} instead of {words}");
    }
    assert!(read_square("solid\n").expect_err("no mesh").contains("not a Gmsh mesh"));
    assert!(read_square("\n\n").expect_err("no mesh").contains("square.msh: is empty"));
}

#[test]
fn format_2_is_refused_with_line_and_remedy() {
    let table = [
        ("1 15 2 0 1 14\n2", "1 15 9 0 1 14\n2", "line 20: in $Elements, expected 9 tags and 1 nodes"),
        ("3 2 2 8 6 10 11 12", "3 2 2 8 6 10 11", "line 22: in $Elements, expected 2 tags and 3 nodes"),
        ("3 2 2 8 6 10 11 12", "3 2 4 8 6 1 3 10 11 12", "line 22: is partitioned"),
        ("3 2 2 8 6 10 11 12", "3 4 2 8 6 10 11 12 13", "mesh the plane scene with `gmsh -2`"),
        ("3 2 2 8 6 10 11 12", "3 2 2 0 6 10 11 12", "exactly one physical surface (its body); found no physical surface"),
        ("4 2 2 8 6 10 13 12", "4 2 2 9 6 12 11 10", "exactly one physical surface (its body); found plate, again"),
        ("4 2 2 8 6 10 13 12", "4 2 2 8 6 12 11 10", "overlaps a triangle before it"),
        ("14 9 9 0\n", "", "expected 4 numbers, found `$EndNodes`"),
        ("4\n1 15", "5\n1 15", "expected 3 numbers, found `$EndElements`"),
        ("$Nodes", "$ParametricNodes", "cut off"),
    ];
    for (good, bad, words) in table {
        let found = read_square(&SQUARE_2.replacen(good, bad, 1)).expect_err(words);
        assert!(found.contains(words), "{found} instead of {words}");
    }
}

/// Groups without a name are known by their numbers, whether or not others have one.
#[test]
fn groups_without_names_are_known_by_their_numbers() {
    let names = |text: &str| {
        let named = text.split_once("$PhysicalNames").expect("names").0;
        format!("{named}{}", text.split_once("$EndPhysicalNames\n").expect("an end").1)
    };
    for text in [SQUARE, SQUARE_2] {
        let mesh = read_square(&names(text)).expect("a file without names");
        assert_eq!((mesh.bodies, mesh.boundaries[0].name.as_str()), (vec!["8".to_string()], "7"));
    }
    let bare = names(SQUARE).replace("1 0 1 7 0", "1 0 0 0").replace("1 1 0 1 8 0", "1 1 0 0 0");
    let words = read_square(&bare).expect_err("no groups");
    assert!(words.contains("has no physical surfaces; name the bodies"), "{words}");
}

#[test]
fn fields_of_names_may_stand_apart() {
    let mesh = read_square(&SQUARE.replace("1 7 \"lower edge\"", " 1   7\t \"lower edge\"")).expect("a good file");
    assert_eq!(mesh.boundaries[0].name, "lower edge");
}

#[test]
fn triangles_without_a_group_are_told_with_the_word_that_saves_them() {
    let words = read_square(&SQUARE_2.replace("3 2 2 8 6", "3 2 2 0 6")).expect_err("one triangle has none");
    assert!(
        words.contains("name its surface with `Physical Surface(\"name\") = {...}`") && words.contains("Mesh.SaveAll"),
        "{words}"
    );
}
