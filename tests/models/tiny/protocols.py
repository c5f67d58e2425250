"""Chats, the Responses API and the Messages API, as far as `motet do` speaks them: what a request asks of the model, and the
events or the whole of a reply. Written after the references of OpenAI and Anthropic; the package of mistral.rs has the model and
no server.
"""

import json

# What the grammar leaves open, a model without sense fills with blanks.
COMPACT = {"x-guidance": {"whitespace_flexible": False}}


def text(content):
    return content if isinstance(content, str) else "".join(part.get("text", "") for part in content)


def said(body, key, instructions):
    turns = [{"role": turn["role"], "content": text(turn["content"])} for turn in body[key]]
    return ([{"role": "system", "content": body[instructions]}] if body.get(instructions) else []) + turns


def schema(value):
    return "json_schema", json.dumps({**value, **COMPACT})


class Chat:
    """Chat completions of OpenAI, with the grammar wherever one of the dialects of `--dialect` puts it."""

    path = "/v1/chat/completions"

    @staticmethod
    def asked(body):
        held = body.get("structured_outputs", {}).get("json")
        held = held or body.get("response_format", {}).get("json_schema", {}).get("schema")
        own = body.get("grammar")
        if own and own["type"] == "lark":
            return body["messages"], ("lark", own["value"])
        held = held or (own and own["value"])
        return body["messages"], held and schema(held)

    @staticmethod
    def whole(reply, why):
        message = {"role": "assistant", "content": reply}
        return {"choices": [{"index": 0, "message": message, "finish_reason": why}]}

    @staticmethod
    def begin():
        return []

    @staticmethod
    def piece(piece):
        return [{"choices": [{"index": 0, "delta": {"content": piece}, "finish_reason": None}]}]

    @staticmethod
    def end(_, why):
        return [{"choices": [{"index": 0, "delta": {}, "finish_reason": why}]}, "[DONE]"]


class Responses:
    path = "/v1/responses"

    def asked(self, body):
        tool = next(iter(body.get("tools", [])), None)
        self.is_tool = tool is not None
        held = ("lark", tool["format"]["definition"]) if tool else None
        if "text" in body:
            held = schema(body["text"]["format"]["schema"])
        return said(body, "input", "instructions"), held

    def item(self, reply):
        if self.is_tool:
            return {"type": "custom_tool_call", "name": "motet_policy", "call_id": "1", "input": reply}
        return {"type": "message", "role": "assistant", "content": [{"type": "output_text", "text": reply}]}

    def whole(self, reply, why):
        is_whole = why == "stop"
        details = None if is_whole else {"reason": "max_output_tokens"}
        status = "completed" if is_whole else "incomplete"
        return {"status": status, "error": None, "incomplete_details": details, "output": [self.item(reply)]}

    @staticmethod
    def begin():
        return [{"type": "response.created", "response": {"status": "in_progress", "output": []}}]

    def piece(self, piece):
        kind = "custom_tool_call_input" if self.is_tool else "output_text"
        return [{"type": f"response.{kind}.delta", "delta": piece}]

    def end(self, reply, why):
        kind = "response.completed" if why == "stop" else "response.incomplete"
        return [{"type": kind, "response": self.whole(reply, why)}]


class Messages:
    path = "/v1/messages"

    def asked(self, body):
        tool = next(iter(body.get("tools", [])), None)
        self.is_tool = tool is not None
        held = tool["input_schema"] if tool else body.get("output_config", {}).get("format", {}).get("schema")
        return said(body, "messages", "system"), held and schema(held)

    @staticmethod
    def reason(why):
        return "end_turn" if why == "stop" else "max_tokens"

    def whole(self, reply, why):
        part = {"type": "text", "text": reply}
        if self.is_tool:
            part = {"type": "tool_use", "name": "motet_policy", "input": json.loads(reply)}
        return {"type": "message", "content": [part], "stop_reason": self.reason(why)}

    def begin(self):
        block = {"type": "tool_use", "input": {}} if self.is_tool else {"type": "text", "text": ""}
        message = {"type": "message", "content": [], "stop_reason": None}
        return [
            {"type": "message_start", "message": message},
            {"type": "content_block_start", "index": 0, "content_block": block},
        ]

    def piece(self, piece):
        delta = {"type": "text_delta", "text": piece}
        if self.is_tool:
            delta = {"type": "input_json_delta", "partial_json": piece}
        return [{"type": "content_block_delta", "index": 0, "delta": delta}]

    def end(self, _, why):
        return [
            {"type": "content_block_stop", "index": 0},
            {"type": "message_delta", "delta": {"stop_reason": self.reason(why)}},
            {"type": "message_stop"},
        ]


PROTOCOLS = {protocol.path: protocol for protocol in (Chat, Responses, Messages)}
