"""A run of tests inside Blender is judged by pytest's report, since the bpy module may crash after all is done."""

import sys

import pytest
from checkout import ROOT

sys.path.append(str(ROOT / "scripts"))
from run_blender_tests import judge


@pytest.fixture
def report(tmp_path):
    def write(tests=3, failures=0, errors=0, skipped=0):
        counts = f'tests="{tests}" failures="{failures}" errors="{errors}" skipped="{skipped}"'
        path = tmp_path / "report.xml"
        path.write_text(f'<testsuites><testsuite name="pytest" {counts}></testsuite></testsuites>')
        return path

    return write


@pytest.mark.parametrize("status", [0, -11, 139])
def test_a_crash_after_the_last_test_is_forgiven(report, status):
    assert judge(report(), status) == 0


@pytest.mark.parametrize("status", [0, 1, -11, 139])
@pytest.mark.parametrize("counts", [{"failures": 1}, {"errors": 1}])
def test_a_failure_is_never_forgiven(report, counts, status):
    assert judge(report(**counts), status) == 1


@pytest.mark.parametrize("counts", [{"tests": 0}, {"tests": 2, "skipped": 2}])
def test_where_no_test_ran_there_is_no_success(report, counts):
    assert judge(report(**counts), 0) == 1


@pytest.mark.parametrize(("status", "verdict"), [(0, 1), (-11, -11), (139, 139)])
def test_without_a_report_there_is_no_success(tmp_path, capsys, status, verdict):
    assert judge(tmp_path / "report.xml", status) == verdict
    assert f"no report (exit status {status})" in capsys.readouterr().err


def test_an_exit_status_that_is_no_crash_is_passed_on(report):
    assert judge(report(), 2) == 2
