"""The numbers of all cases as CSV."""

import csv

import numpy as np
import pytest

from myograph.case import MUSCLES
from myograph.ensemble.store.opening import open_muscle
from myograph.errors import InputError
from myograph.export.csv import write_csv
from tests.ensemble.filled import filled_store


@pytest.fixture(scope="module")
def store(tmp_path_factory):
    return filled_store(tmp_path_factory.mktemp("csv") / "store", preset="fail=500")


def test_every_case_has_a_row_with_what_was_asked_and_how_far_its_muscles_went(store, tmp_path):
    assert write_csv(tmp_path / "all.csv", store) == 12
    with (tmp_path / "all.csv").open() as file:
        rows = list(csv.DictReader(file))
    data = open_muscle(store, "triceps")
    assert {row["state"] for row in rows} == {"done", "failed"}
    for case, row in enumerate(rows):
        assert int(row["case"]) == case
        assert [float(row[name]) for name in MUSCLES] == data["activation"].values[case].tolist()
        if row["state"] == "failed":
            assert row["elbow_angle_deg"] == row["triceps_von_mises_max_mpa"] == ""
            continue
        assert np.radians(float(row["elbow_angle_deg"])) == pytest.approx(float(data["elbow_angle"][case]))
        assert 1e3 * float(row["moment_nm_biceps"]) == pytest.approx(float(data["moment"][case, 2]))
        assert float(row["triceps_von_mises_max_mpa"]) == pytest.approx(float(data["von_mises"][case].max()))
        way = np.linalg.norm(data["position"].values[case] - data["reference_position"].values, axis=1)
        assert float(row["triceps_displacement_mean_mm"]) == pytest.approx(way.mean(), rel=1e-6)


def test_another_file_is_not_replaced(store, tmp_path):
    (tmp_path / "all.csv").write_text("a,b\n1,2\n")
    with pytest.raises(InputError, match="something else"):
        write_csv(tmp_path / "all.csv", store)


def test_a_folder_without_a_store_is_refused(tmp_path):
    with pytest.raises(InputError, match="expected the store of an ensemble"):
        write_csv(tmp_path / "all.csv", tmp_path)
