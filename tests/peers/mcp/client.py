#!/usr/bin/env python3
"""The official Python client of the Model Context Protocol with `motet mcp`, in both versions, on stdio and over HTTP."""

import asyncio
import os
import re
import subprocess
import sys
import tempfile
from typing import Any, ClassVar, Literal

import httpx2
from mcp import Client, MCPError
from mcp.client.extension import ClientExtension, ResultClaim
from mcp.client.stdio import StdioServerParameters
from mcp.client.streamable_http import streamable_http_client
from mcp_types import CallToolResult, ElicitResult, Request, RequestParams, Result

MOTET = os.path.abspath(sys.argv[1])
HERE = ["mcp", "--robot", "hsr", "--scene", "kitchen"]
DRIVE = ["--drive", "kinematic", "--speed", "max", "--profile", "ideal"]
VERSIONS = {"legacy": "2025-11-25", "2026-07-28": "2026-07-28", "auto": "2026-07-28"}
READ_ONLY = {"robots", "scene", "primitives", "check_policy", "explain", "feasible", "plan", "simulate_policy", "run_status"}
ASK = 'policy asks for hsr { let answer = ask("Shall I go?") go(kitchen_table) say(answer) done }'
CHOOSE = 'policy chooses for hsr { let it = choose("Which mug?", [mug_1, mug_2]) go(it) done }'
TIDY = ["in(mug_1, cupboard_1)", "in(glass_1, cupboard_1)", "in(coke, fridge_1)", "not open(fridge_1)"]
TOKEN = "a-token-for-this-test-0123456789"


class TaskParams(RequestParams):
    taskId: str
    inputResponses: dict[str, Any] | None = None


class TaskRequest(Request[TaskParams, str]):
    method: str
    params: TaskParams
    name_param: ClassVar[str] = "taskId"


class TaskResult(Result):
    model_config = {"extra": "allow"}


class CreatedTask(Result):
    model_config = {"extra": "allow"}
    result_type: Literal["task"] = "task"
    taskId: str


class Tasks(ClientExtension):
    """The extension for tasks: polls a task, and answers its questions with the last option, or yes."""

    identifier = "io.modelcontextprotocol/tasks"

    def __init__(self):
        self.asked, self.ids = [], []

    def claims(self):
        return [ResultClaim(result_type="task", model=CreatedTask, resolve=self.follow)]

    async def follow(self, created, context):
        self.ids.append(created.taskId)
        while True:
            task = await send(context.session, "tasks/get", taskId=created.taskId)
            if task["status"] == "input_required":
                for key, request in task["inputRequests"].items():
                    self.asked.append(request["params"])
                    options = request["params"]["requestedSchema"]["properties"]["answer"].get("enum", ["yes"])
                    answer = {"action": "accept", "content": {"answer": options[-1]}}
                    await send(context.session, "tasks/update", taskId=created.taskId, inputResponses={key: answer})
            elif task["status"] != "working":
                return CallToolResult.model_validate(task["result"])
            await asyncio.sleep(0.02)


class Person:
    """A person who answers yes to a question that comes in place of a result."""

    def __init__(self):
        self.asked = []

    async def __call__(self, context, question):
        self.asked.append(question.message)
        return ElicitResult(action="accept", content={"answer": "yes"})


async def send(session, method, **params):
    """A request of the extension."""
    result = await session.send_request(TaskRequest(method=method, params=TaskParams(**params)), TaskResult)
    return result.model_dump(by_alias=True)


async def call(client, tool, **arguments):
    """The answer of a tool."""
    result = await client.call_tool(tool, arguments)
    assert not result.is_error, (tool, result.structured_content)
    return result.structured_content


async def refuse(client, tool, **arguments):
    """The reason why a tool refuses a call."""
    result = await client.call_tool(tool, arguments)
    assert result.is_error, (tool, result.structured_content)
    return result.structured_content["error"]


async def looks(client):
    """What a client without a robot does."""
    assert "hsr" in [robot["name"] for robot in (await call(client, "robots"))["robots"]]
    assert "mug_1" in [entity["id"] for entity in (await call(client, "scene"))["entities"]]
    assert "pick" in (await call(client, "primitives", name="pick"))["primitives"]
    policy = (await call(client, "plan", request="bring me the red mug"))["policy"]
    checked = await call(client, "check_policy", policy=policy)
    assert checked["ok"] and not checked["errors"], checked
    wrong = await call(client, "check_policy", policy=policy.replace("pick(", "pikc("))
    assert not wrong["ok"] and "pick(" in wrong["fixed"]["policy"], wrong
    code = wrong["diagnostics"][0]["code"]
    assert code in (await call(client, "explain", code=code))["page"]
    simulated = await call(client, "simulate_policy", policy=policy, seed=3, profile="ideal")
    assert simulated["outcome"] == "done" and simulated["events"], simulated
    result = await client.call_tool("feasible", {"motions": ["reach(mug_1)", "go_to(shelf)"]})
    assert result.structured_content["answers"][0]["answer"] == "feasible", result
    assert result.content[1].resource.text.startswith("<svg"), result
    uris = [str(resource.uri) for resource in (await client.list_resources()).resources]
    for uri in ["motet://manual/language", "skill://motet/SKILL.md", "motet://stdlib/motion.motet"]:
        assert uri in uris, uris
        assert len((await client.read_resource(uri)).contents[0].text) > 500
    try:
        await client.read_resource("motet://journal/../../etc")
        raise AssertionError("a path out of the folder was read")
    except MCPError as error:
        assert "no resource" in str(error), error
    assert "no driver" in await refuse(client, "run_policy", policy=policy)


async def drives(client, tasks, person):
    """What a client with a robot does."""
    for tool in (await client.list_tools()).tools:
        assert tool.annotations.read_only_hint == (tool.name in READ_ONLY), tool
        assert tool.annotations.destructive_hint == (tool.name in {"run_policy", "swap_policy"}), tool
    assert "refuses" in await refuse(client, "run_policy", policy="policy p for hsr { place(mug_1, shelf) }")
    assert "no run" in await refuse(client, "swap_policy", policy=ASK)
    if tasks:
        ran = await call(client, "run_policy", policy=ASK)
        assert tasks.ids == [ran["run"]] and tasks.asked[0]["message"] == "Shall I go?", tasks.asked
        try:
            await send(client.session, "tasks/get", taskId="../../etc")
            raise AssertionError("a forged task was read")
        except MCPError as error:
            assert "no run" in str(error), error
    elif person:
        ran = await call(client, "run_policy", policy=ASK)
        assert person.asked == ["Shall I go?"], person.asked
    else:
        asked = await call(client, "run_policy", policy=ASK)
        assert asked["status"] == "input_required" and asked["question"]["question"] == "Shall I go?", asked
        assert "one at a time" in await refuse(client, "run_policy", policy=ASK)
        await call(client, "answer_question", run=asked["run"], answer="yes")
        ran = await call(client, "run_status", run=asked["run"], wait_secs=20)
    assert ran["status"] == "done", ran
    journal = (await client.read_resource(f"motet://journal/{ran['run']}")).contents[0].text
    assert "kitchen_table" in journal
    # The world is as the run has left it.
    put = (await call(client, "plan", goals=["on(mug_1, shelf)"]))["policy"]
    assert (await call(client, "run_policy", policy=put))["status"] == "done"
    facts = (await call(client, "scene"))["facts"]
    assert "on(mug_1, shelf)" in facts, facts


async def tidies(client, tasks):
    """What an agent does that is asked to tidy the kitchen, by the tools alone."""
    facts = (await call(client, "scene"))["facts"]
    assert "in(mug_1, cupboard_1)" not in facts, facts
    answers = {one["query"]: one["answer"] for one in (await call(client, "feasible"))["answers"]}
    assert answers["reach(mug_1)"] == "feasible" and answers["reach(plate)"] == "infeasible", answers
    vague = await refuse(client, "plan", request="tidy up")
    assert vague, vague
    policy = (await call(client, "plan", goals=TIDY))["policy"]
    outcomes = [(await call(client, "simulate_policy", policy=policy, seed=seed))["outcome"] for seed in range(3)]
    assert set(outcomes) <= {"done", "failed"}, outcomes
    for _ in range(5):
        if (await call(client, "run_policy", policy=policy))["status"] == "done":
            break
        left = [goal for goal in TIDY if goal not in (await call(client, "scene"))["facts"]]
        policy = (await call(client, "plan", goals=left))["policy"]
    facts = (await call(client, "scene"))["facts"]
    assert set(TIDY) <= set(facts), facts
    # The options of a question reach the person, and the answer the policy.
    chosen = await call(client, "run_policy", policy=CHOOSE)
    assert chosen["status"] == "done" and tasks.asked[-1]["message"].startswith("Which mug?"), (chosen, tasks.asked)
    assert "mug_2" in (await client.read_resource(f"motet://journal/{chosen['run']}")).contents[0].text


async def on_stdio(folder):
    for mode, version in VERSIONS.items():
        parameters = StdioServerParameters(command=MOTET, args=HERE, cwd=folder)
        async with Client(parameters, mode=mode) as client:
            assert client.session.protocol_version == version
            await looks(client)
        tasks, person = Tasks() if mode == "2026-07-28" else None, Person() if mode == "auto" else None
        parameters = StdioServerParameters(command=MOTET, args=HERE + DRIVE, cwd=folder)
        more = {"extensions": [tasks] if tasks else None, "elicitation_callback": person}
        async with Client(parameters, mode=mode, **more) as client:
            await drives(client, tasks, person)
        if tasks:
            more = {"extensions": [tasks := Tasks()]}
            async with Client(parameters, mode=mode, **more) as client:
                await tidies(client, tasks)
        print(f"stdio, {mode}: {version}")


async def over_http(folder):
    environment = {**os.environ, "MOTET_TOKEN": TOKEN}
    line = [MOTET, *HERE, *DRIVE, "--http", "0", "--token-from", "MOTET_TOKEN"]
    server = subprocess.Popen(line, stderr=subprocess.PIPE, text=True, env=environment, cwd=folder)
    try:
        address = next(found[1] for said in server.stderr if (found := re.search(r"listening on (\S+)", said)))
        bearer = {"Authorization": f"Bearer {TOKEN}"}
        for mode in ["legacy", "2026-07-28"]:
            async with httpx2.AsyncClient(headers=bearer, timeout=60) as http:
                async with Client(streamable_http_client(address, http_client=http), mode=mode) as client:
                    assert client.session.protocol_version == VERSIONS[mode]
                    assert (await call(client, "check_policy", policy="policy p for hsr { say(\"Hi\") }"))["ok"]
                    ran = await call(client, "run_policy", policy='policy p for hsr { say("Hi") }')
                    assert ran["status"] == "done", ran
            print(f"http, {mode}: {VERSIONS[mode]}")
        list_tools = {"jsonrpc": "2.0", "id": 1, "method": "tools/list", "params": {}}
        accept = {"Accept": "application/json, text/event-stream"}
        async with httpx2.AsyncClient() as http:
            for headers, status in [
                ({}, 401),
                ({"Authorization": "Bearer wrong"}, 401),
                ({"Authorization": f"Basic {TOKEN}"}, 401),
                ({**bearer, "Host": "evil.example"}, 403),
                ({**bearer, "Origin": "https://evil.example"}, 403),
            ]:
                answer = await http.post(address, json=list_tools, headers=accept | headers)
                assert answer.status_code == status, (headers, answer)
            long = {**list_tools, "params": {"x": "y" * 2_000_000}}
            try:
                answer = await http.post(address, json=long, headers=accept | bearer)
                assert answer.status_code == 413, answer
            except httpx2.TransportError:
                pass  # The server does not read on, so the client may see the end of the connection first.
        # In a connection of its own: the server has closed the one whose request it did not read.
        async with httpx2.AsyncClient() as http:
            answer = await http.post(address.replace("/mcp", "/other"), json=list_tools, headers=accept | bearer)
            assert answer.status_code == 404, answer
        print("http: strangers are refused")
    finally:
        server.terminate()
        assert server.wait(30) == 130


async def main():
    with tempfile.TemporaryDirectory() as folder:
        await on_stdio(folder)
        await over_http(folder)


asyncio.run(main())
