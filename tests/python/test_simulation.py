"""Every operation of both clients, against a real server."""

from __future__ import annotations

import json
import pathlib
from typing import Any

import headrace
import numpy as np
import pytest
from headrace._json import Reply, with_numbers

from conftest import tank


def test_load_takes_a_preset_a_document_and_a_file(server: Any, tmp_path: pathlib.Path) -> None:
    server.cancel()
    assert server.load("dam_break_2d").particles == 3200
    assert server.load(tank("thesis")).particles == 200
    (tmp_path / "mine.json").write_text(json.dumps(tank("thesis", spacing=0.04)))
    assert server.load(tmp_path / "mine.json").particles == 50
    assert server.load(str(tmp_path / "mine.json"), parameters={"viscosity": 7.0}).scene == "small"
    assert server.params["viscosity"] == 7.0
    assert server.scene["spacing"] == 0.04
    assert "dam_break" in [scene.name for scene in server.scenes()]


@pytest.mark.parametrize("text, kind", [('{"a": 1,}', headrace.ParseError), ('{"a": NaN}', headrace.ParseError),
                                        ("[]", headrace.ParseError), ('{"a": 1, "a": 2}', headrace.DuplicateKey)])
def test_a_bad_scene_file_is_named(sim: Any, tmp_path: pathlib.Path, text: str, kind: type[headrace.Error]) -> None:
    file = tmp_path / "bad.json"
    file.write_text(text)
    with pytest.raises(kind):
        sim.load(file)
    with pytest.raises(headrace.FileError, match="No such file"):
        sim.load(tmp_path / "none.json")
    assert sim.status().scene == "small"


def test_runs_end_where_they_were_told_to(sim: Any) -> None:
    dt = sim.status().time_step
    assert sim.step(3).step == 3
    assert sim.step().step == 4
    assert sim.run(until="step=10").step == 10
    assert sim.run(until="steps=5").step == 15
    # A run to a time ends with the first step that reaches it.
    assert 0.2 <= sim.run(until=0.2).time < 0.2 + dt
    before = sim.status().time
    assert before + 0.1 <= sim.run(until="+0.1").time + 1e-12 < before + 0.1 + dt
    assert sim.run(until={"steps": 2}).steps == 2


def test_a_run_ends_at_the_first_sample_that_fulfils_its_condition(sim: Any) -> None:
    job = sim.run(until="tip>0.5")
    assert job.state == "finished" and sim.probes["tip"].values[-1] > 0.5 >= sim.probes["tip"].values[-2]


def test_a_run_to_rest_ends_at_rest(sim: Any) -> None:
    sim.load(tank("thesis", at_rest={"speed_factor": 1e6, "share": 0.5, "duration": 0.01, "timeout": 5}))
    assert sim.run(until="at-rest").state == "finished"


def test_ends_of_another_kind_are_exceptions(sim: Any) -> None:
    with pytest.raises(headrace.TimedOut, match="step"):
        sim.run(until="tip>100", timeout=0.05)
    sim.run(until="steps=1000000", wait=False)
    with pytest.raises(headrace.TimedOut):
        sim.wait(timeout=0.0)
    sim.cancel()
    with pytest.raises(headrace.Cancelled):
        sim.wait()


def test_a_faulted_run_tells_the_remedy(water: Any) -> None:
    # Without a tank the column falls out of the domain.
    water.load(tank("wcsph", objects=[]))
    with pytest.raises(headrace.Faulted, match="domain") as caught:
        water.run(until=2.0)
    assert caught.value.hint
    fault = water.status().fault
    assert fault.criterion == "left_domain" and fault.position[1] < -0.2
    with pytest.raises(headrace.WrongState):
        water.step()


def test_pause_resume_cancel_and_reset(sim: Any) -> None:
    job = sim.run(until="steps=1000000", wait=False)
    assert job.state == "running"
    sim.pause()
    assert sim.status().job.state == "paused"
    sim.resume()
    assert sim.status().state == "running"
    sim.cancel()
    assert sim.status().state == "idle"
    assert sim.reset().step == 0


@pytest.mark.parametrize("until", ["soon", "tip>", ">3", "step=x", True, object()])
def test_ends_that_make_no_sense_are_refused(sim: Any, until: Any) -> None:
    with pytest.raises(headrace.Usage, match="no end of a run"):
        sim.run(until=until)


def test_a_run_without_end_is_not_waited_for(sim: Any) -> None:
    with pytest.raises(headrace.Usage):
        sim.run()


def test_parameters_are_a_mapping_with_units(sim: Any) -> None:
    sim.params["viscosity"] = 2.5
    assert sim.params["viscosity"] == 2.5
    info = sim.params.info("viscosity")
    assert (info.value, info.unit) == (2.5, "Pa s") and "viscosity" in info.meaning
    assert "viscosity" in list(sim.params) and sim.params.all()["viscosity"] == info
    done = sim.params.set({"viscosity": np.float64(3)}, gravity=np.array([0, -1.0, 0]))
    assert done.previous.viscosity == 2.5 and sim.params["gravity"] == [0, -1, 0]
    with pytest.raises(headrace.ParameterNotFound, match="viscosity"):
        sim.params["viscosty"]
    with pytest.raises(headrace.ParameterNotFound):
        sim.params["viscosty"] = 1
    with pytest.raises(headrace.InvalidParams, match="finite"):
        sim.params["viscosity"] = float("nan")


def test_a_parameter_may_wait_for_its_step(sim: Any) -> None:
    sim.run(pace=1, wait=False)
    ahead = 2
    while True:  # the run may be faster than the request: then further ahead
        step = sim.status().step + ahead
        try:
            assert sim.params.set(viscosity=4.0, at_step=step).step == step
            break
        except headrace.InvalidParams as error:
            assert "is past" in str(error)
            ahead *= 2
    sim.cancel()
    assert sim.params["viscosity"] == 4.0


def test_objects_are_added_moved_and_removed(sim: Any) -> None:
    sim.objects.add("ball", {"sphere": {"center": [0.6, 0.1], "radius": 0.05}})
    assert list(sim.objects) == ["tank", "ball"]
    sim.objects.move("ball", by=np.array([0.0, 0.1]))
    assert sim.objects["ball"].shape.sphere.center == pytest.approx([0.6, 0.2, 0])
    sim.objects.move("ball", to=[0.5, 0.3])
    assert sim.objects.all()["ball"].shape.sphere.center == [0.5, 0.3, 0]
    with pytest.raises(headrace.ObjectExists):
        sim.objects.add("ball", {"sphere": {"center": [0.6, 0.1], "radius": 0.05}})
    sim.objects.remove("ball")
    assert list(sim.objects) == ["tank"]
    with pytest.raises(headrace.ObjectNotFound, match="ball"):
        sim.objects["ball"]


def test_a_plane_can_be_added_with_motion(water: Any) -> None:
    water.objects.add("ramp", {"plane": {"point": [0, -0.1], "normal": [0, 1]}}, motion={"displacement": [0, "-0.1*t"]})
    assert water.objects["ramp"].motion.displacement[1] == "-0.1*t"


def test_probes_become_arrays(sim: Any) -> None:
    sim.probes.add("gauge", {"level": {"from": [0.7, 0], "to": [0.7, 0.6]}}, every_steps=2)
    sim.probes.add("stir", {"velocity": {"point": [0.7, 0.5]}}, every_steps=1)
    sim.step(10)
    tip = sim.probes["tip"]
    assert tip.columns == ("front",) and tip.unit == "m" and tip.times.shape == tip.values.shape == (11,)
    assert tip.values[0] == pytest.approx(0.2) and np.all(np.diff(tip.times) > 0)
    assert np.array_equal(tip["front"], tip.values)
    stir = sim.probes["stir"]
    assert stir.values.shape == (11, 2) and stir.unit == "m/s"
    assert np.isnan(stir.values).all()  # no fluid there: nan, not a number that could be taken for one
    assert np.isnan(stir["vy"]).all()
    assert len(sim.probes["gauge"]) == 6
    assert len(sim.probes.get("tip", since=tip.times[7])) == 3
    with pytest.raises(headrace.ProbeNotFound, match="vx"):
        stir["vz"]
    assert list(sim.probes) == ["tip", "gauge", "stir"] and sim.probes.all()["gauge"].samples == 6
    sim.probes.remove("gauge")
    with pytest.raises(headrace.ProbeNotFound):
        sim.probes["gauge"]


def test_a_profile_tells_its_places(water: Any) -> None:
    water.probes.add("line", {"profile": {"field": "pressure", "from": [0.1, 0.05], "to": [0.1, 0.35], "points": 4}})
    line = water.probes["line"]
    assert line.values.shape == (1, 4) and line.positions == pytest.approx([0, 0.1, 0.2, 0.3])


def test_a_long_series_comes_whole(sim: Any) -> None:
    # More than the 10,000 samples that one reply holds.
    sim.load(tank("thesis", spacing=0.2))
    sim.step(12_000)
    tip = sim.probes["tip"]
    assert len(tip) == 12_001 and np.all(np.diff(tip.times) > 0)


def test_status_plan_events_and_hash(sim: Any) -> None:
    seen = sim.events().last_seq
    sim.step(2)
    status = sim.status(hash=True)
    assert (status.state, status.step, status["particles"]) == ("idle", 2, 200)
    assert status.state_hash.step == 2 and len(status.state_hash.value) == 16
    assert "fault" not in status and status.fault is None
    assert {stage.stage for stage in sim.plan} >= {"neighbours", "density"}
    types = [event.type for event in sim.events(seen).events]
    assert types == ["job.started", "job.ended"]
    assert sim.events(seen, types=["job.ended"]).events[0].step == 2


def test_inspect_explains_a_particle(water: Any) -> None:
    water.step(2)
    frame = water.snapshot(["id", "position"], precision="f8")
    found = water.inspect(17)
    assert np.array_equal(found.position[:2], frame.position[17])
    total = sum(term.acceleration for term in found.terms)
    # Round-off of a sum of about ten terms in double precision.
    assert total == pytest.approx(found.acceleration, rel=1e-9, abs=1e-9)
    with pytest.raises(headrace.ParticleNotFound):
        water.inspect(200)


def test_a_snapshot_has_what_was_asked_for(sim: Any) -> None:
    frame = sim.snapshot()
    assert list(frame) == ["id", "position", "velocity", "density", "pressure"]
    assert frame.position.shape == (200, 2) and frame.position.dtype == np.float32
    assert np.array_equal(frame.ids, np.arange(200))
    assert (frame.step, frame.time, frame.session) == (0, 0.0, sim.session)
    # The lattice: half a spacing from the wall, to single precision.
    assert frame.position.min(axis=0) == pytest.approx([0.01, 0.01], rel=1e-6)
    double = sim.snapshot(["acceleration"], precision="f8")
    assert list(double) == ["acceleration"] and double.acceleration.dtype == np.float64
    with pytest.raises(headrace.InvalidParams, match="colour"):
        sim.snapshot(["colour"])


def test_call_reaches_every_method(sim: Any) -> None:
    assert sim.call("hello")["program"] == "headraced"
    assert sim.call("sim.step", steps=2)["step"] == 2
    with pytest.raises(headrace.MethodNotFound) as caught:
        sim.call("sim.stop")
    assert caught.value.name == "method_not_found"


def test_errors_tell_place_and_remedy(sim: Any) -> None:
    with pytest.raises(headrace.ObjectNotFound) as caught:
        sim.objects.remove("tnak")
    error = caught.value
    assert (error.name, error.path, error.retryable) == ("object_not_found", "params.name", False)
    assert "tank" in error.hint and "tank" in str(error)
    with pytest.raises(headrace.SceneInvalid) as scene:
        sim.load(tank("thesis", spacing=0.9))
    assert scene.value.path.startswith("scene.fluids[0]")


def test_numbers_that_json_lacks_arrive_as_numbers() -> None:
    reply = Reply(with_numbers({"fault": {"position": [0.1, "NaN"], "velocity": ["Infinity", "-Infinity"]},
                                "neighbours": [{"object": "NaN", "distance": "NaN"}]}))
    assert np.array_equal(reply.fault.position, [0.1, np.nan], equal_nan=True)
    assert reply.fault.velocity == [np.inf, -np.inf]
    assert reply.neighbours[0].object == "NaN" and np.isnan(reply.neighbours[0].distance)


def test_no_server_answers_within_patience() -> None:
    with pytest.raises(headrace.ConnectionFailed, match="127.0.0.1:1"):
        headrace.Simulation("tcp://127.0.0.1:1", patience=0.2)
    with pytest.raises(headrace.Usage, match="endpoint"):
        headrace.Simulation("nowhere")


def test_a_second_client_joins_a_private_server(server: Any) -> None:
    with headrace.Simulation(server.endpoint) as other:
        assert other.session == server.session
