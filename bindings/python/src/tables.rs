//! Keywords of Python as tables of a scene file.

use pyo3::exceptions::PyTypeError;
use pyo3::prelude::*;
use pyo3::types::{PyBool, PyDict, PyFloat, PyInt, PyString};
use toml_edit::{Array, ArrayOfTables, DocumentMut, InlineTable, Item, Table, Value};

/// Puts the values of `keywords` into a document. A dict changes the keys that it names of a table,
/// and `None` takes a key away. `move` and `moves` take each other's place, and a move that has a
/// profile or waypoints takes the old one's place as a whole.
pub fn merge(document: &mut DocumentMut, keywords: &Bound<'_, PyDict>) -> PyResult<()> {
    for (one, other) in [("move", "moves"), ("moves", "move")] {
        if keywords.get_item(one)?.is_some_and(|value| !value.is_none()) {
            document.remove(other);
        }
    }
    if let Some(motion) = keywords.get_item("move")?
        && let Ok(motion) = motion.cast::<PyDict>()
        && (motion.contains("profile")? || motion.contains("waypoints")?)
    {
        document.remove("move");
    }
    merge_into(document.as_table_mut(), keywords, "")
}

fn merge_into(table: &mut Table, keywords: &Bound<'_, PyDict>, path: &str) -> PyResult<()> {
    for (key, value) in keywords {
        let key: String = key.extract()?;
        let path = if path.is_empty() { key.clone() } else { format!("{path}.{key}") };
        if value.is_none() {
            table.remove(&key);
            continue;
        }
        if let Ok(inner) = value.cast::<PyDict>() {
            let old = table.remove(&key).and_then(|item| item.into_table().ok());
            let mut new = old.unwrap_or_default();
            merge_into(&mut new, inner, &path)?;
            table.insert(&key, Item::Table(new));
        } else {
            table.insert(&key, item(&value, &path)?);
        }
    }
    Ok(())
}

/// Returns a value as an item. A list of dicts becomes an array of tables.
fn item(value: &Bound<'_, PyAny>, path: &str) -> PyResult<Item> {
    let list: Option<Vec<Bound<'_, PyAny>>> =
        if value.is_instance_of::<PyString>() { None } else { value.extract().ok() };
    let Some(list) = list.filter(|list| {
        !list.is_empty() && list.iter().all(|entry| entry.is_instance_of::<PyDict>())
    }) else {
        return Ok(Item::Value(plain(value, path)?));
    };
    let mut tables = ArrayOfTables::new();
    for (index, entry) in list.iter().enumerate() {
        let mut table = Table::new();
        merge_into(&mut table, entry.cast::<PyDict>()?, &format!("{path}[{index}]"))?;
        tables.push(table);
    }
    Ok(Item::ArrayOfTables(tables))
}

/// Returns a number, a word, or a list of them. Arrays and scalars of numpy are taken by their
/// `tolist`.
fn plain(value: &Bound<'_, PyAny>, path: &str) -> PyResult<Value> {
    if let Ok(flag) = value.cast::<PyBool>() {
        return Ok(flag.is_true().into());
    }
    if value.is_instance_of::<PyInt>() {
        return Ok(value.extract::<i64>()?.into());
    }
    if let Ok(number) = value.cast::<PyFloat>() {
        return Ok(number.extract::<f64>()?.into());
    }
    if let Ok(word) = value.cast::<PyString>() {
        return Ok(word.to_string().into());
    }
    if let Ok(dict) = value.cast::<PyDict>() {
        let mut table = InlineTable::new();
        for (key, entry) in dict {
            let key: String = key.extract()?;
            table.insert(&key, plain(&entry, &format!("{path}.{key}"))?);
        }
        return Ok(table.into());
    }
    if let Ok(list) = value.call_method0("tolist") {
        return plain(&list, path);
    }
    let Ok(list) = value.extract::<Vec<Bound<'_, PyAny>>>() else {
        return Err(PyTypeError::new_err(format!(
            "{path}: a {}; must be a number, a str, a bool, a dict, or a list or an array of them",
            value.get_type().name()?
        )));
    };
    let mut array = Array::new();
    for (index, entry) in list.iter().enumerate() {
        array.push(plain(entry, &format!("{path}[{index}]"))?);
    }
    Ok(array.into())
}
