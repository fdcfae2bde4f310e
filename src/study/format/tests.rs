use super::*;
use serde_json::json;

fn table() -> Table {
    let row = |cells: Value| cells.as_array().unwrap().clone();
    Table {
        study: "hard".into(),
        errors: vec!["errors.energy".into()],
        time: "time_s.total".into(),
        columns: [
            ("case", ColumnKind::Given),
            ("repeat", ColumnKind::Detail),
            ("status", ColumnKind::Main),
            ("reason", ColumnKind::Main),
            ("error", ColumnKind::Main),
            ("contact.\"a,b\".trust", ColumnKind::Main),
            ("wall_s", ColumnKind::Detail),
        ]
        .map(|(name, kind)| Column::new(name, kind))
        .to_vec(),
        rows: vec![
            row(json!(["bars", 1, "converged", "residual", 0.1 + 0.2, null, 1.5])),
            row(json!(["bars, \"bent\"", 1, "failed", "a | b\nc", null, null, 2.5])),
        ],
        groups: vec![0..1, 1..2],
        good: vec![true, false],
        converged: 1,
        machines: vec!["Great CPU, 2 cores, 24 GiB".into()],
        blas: vec!["OpenBLAS".into()],
    }
}

#[test]
fn csv_is_quoted_and_exact() {
    let expected = concat!(
        "case,repeat,status,reason,error,\"contact.\"\"a,b\"\".trust\",wall_s\n",
        "bars,1,converged,residual,0.30000000000000004,,1.5\n",
        "\"bars, \"\"bent\"\"\",1,failed,\"a | b\nc\",,,2.5\n"
    );
    assert_eq!(csv(&table()), expected);
}

#[test]
fn json_keeps_the_columns_in_order_and_null() {
    let text = json(&table(), &[]);
    let value: Value = serde_json::from_str(&text).unwrap();
    assert_eq!(value["rows"][0]["error"], json!(0.1 + 0.2));
    assert_eq!(value["rows"][1]["error"], Value::Null);
    assert_eq!((&value["error"], &value["study"]), (&json!("errors.energy"), &json!("hard")));
    let places: Vec<usize> = ["\"case\": ", "\"status\": ", "\"reason\": "].map(|key| text.find(key).unwrap()).to_vec();
    assert!(places.is_sorted());
}

#[test]
fn markdown_is_a_page_to_read() {
    let text = markdown(&table());
    assert!(text.starts_with("# Study hard\n\n2 runs, 1 converged; mezha "), "{text}");
    assert!(text.contains("Made on Great CPU, 2 cores, 24 GiB; BLAS: OpenBLAS.") && !text.contains("medians"), "{text}");
    let lines: Vec<&str> = text.lines().skip_while(|line| !line.starts_with('|')).collect();
    let expected = [
        "| case | status | error | reason |",
        "|---|---|---|---|",
        "| bars | converged | 0.3000 |  |",
        "| bars, \"bent\" | failed |  | a \\| b c |",
    ];
    assert_eq!(lines, expected);
}

#[test]
fn numbers_for_people_have_four_digits() {
    let table = [
        (json!(1234.56), "1235"),
        (json!(1.0), "1.000"),
        (json!(-0.012345), "-0.01235"),
        (json!(1e-9), "1.000e-9"),
        (json!(123456.0), "1.235e5"),
        (json!(0.0), "0"),
        (json!(123456), "123456"),
        (json!(true), "true"),
        (json!([1, 2]), "[1,2]"),
        (json!(null), ""),
    ];
    for (value, words) in table {
        assert_eq!(rounded(&value), words);
    }
}

/// The first run made three times, with different times.
fn repeated() -> Table {
    let mut table = table();
    table.rows.splice(1..1, [1.0, 2.5].map(|time| table.rows[0].iter().take(6).cloned().chain([time.into()]).collect()).to_vec());
    (table.groups, table.good) = (vec![0..3, 3..4], vec![true, true, true, false]);
    table.columns[6].kind = ColumnKind::Main;
    super::super::repeats::add_spreads(&mut table, &["wall_s"]);
    table
}

#[test]
fn repeats_are_one_row_with_median_and_extremes() {
    let text = markdown(&repeated());
    assert!(text.contains("4 runs") && text.contains("Times are medians of the repeats that converged"), "{text}");
    assert!(text.contains("| bars | converged | 0.3000 | 1.500 (1.000 – 2.500) |  |\n"), "{text}");
    assert!(text.contains("| bars, \"bent\" | failed |  |  | a \\| b c |\n"), "{text}");
}
