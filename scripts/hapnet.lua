-- SPDX-FileCopyrightText: 2026 The Hapnet authors
-- SPDX-License-Identifier: MIT
--
-- Wireshark's dissector of Hapnet's messages (docs/formats/wire.md, docs/formats/sealed.md):
--     tshark -X lua_script:scripts/hapnet.lua -o udp.try_heuristic_first:TRUE -r RUN.pcapng
-- or copy it into the folder of personal Lua plugins and set that preference of UDP. A message is
-- known by its first four bytes, on any port; the preference keeps others who claim a port back.
-- Sequence, time of sending and age need no key; of a sealed message the rest is shown as bytes.
-- Of any packet in a capture by hapnet-emulator --pcap, its fate is fields to filter and plot by:
--     hapnet.fate == "dropped" && hapnet.cause == "gilbert-elliott", hapnet.delay_ms > 50

local hapnet = Proto("hapnet", "Hapnet")

local types = {
    [1] = "hello", [2] = "state", [3] = "bye",
    [0x81] = "hello, sealed", [0x82] = "state, sealed", [0x83] = "bye, sealed",
    [0x88] = "handshake initiation", [0x89] = "handshake response", [0x8a] = "handshake cookie",
}
local reasons = {
    [0] = "finished", [1] = "interrupted", [2] = "other version", [3] = "other scene",
    [4] = "other task", [5] = "other tick rate", [6] = "same peer id",
}

local f = hapnet.fields
local function field(name, kind, text, ...)
    f[name] = ProtoField[kind]("hapnet." .. name, text, ...)
end
field("version", "uint8", "Version")
field("type", "uint8", "Type", base.HEX, types)
field("session", "uint32", "Session", base.HEX)
field("key", "uint32", "Key of the receiver", base.HEX)
field("number", "uint32", "Number of the seal")
field("sequence", "uint32", "Sequence")
field("sent", "int64", "Sent, ns on the sender's clock")
field("age", "double", "Age, ms, above the least of this stream")
field("flags", "uint8", "Flags", base.HEX)
field("echo_of", "int64", "Echo of, ns")
field("echo_age", "uint32", "Echo age, ns")
field("hip", "string", "HIP, m")
field("hip_velocity", "string", "HIP velocity, m/s")
field("contact_force", "string", "Contact force, N")
field("intention", "string", "Intention from the HIP, m")
field("intention_velocity", "string", "Velocity of the intention, m/s")
field("work", "uint32", "Work on the device, uJ, modulo 2^32")
field("body", "uint16", "Body")
field("position", "string", "Position, m")
field("velocity", "string", "Velocity, m/s")
field("caused_displacement", "string", "Caused displacement, um")
field("caused_impulse", "string", "Caused impulse, uN s")
field("orientation", "uint64", "Orientation", base.HEX)
field("angular_velocity", "string", "Angular velocity, rad/s")
field("caused_rotation", "string", "Caused rotation, urad")
field("caused_angular_impulse", "string", "Caused angular impulse, uN m s")
field("nonce", "uint32", "Nonce", base.HEX)
field("nonce_heard", "uint32", "Nonce heard", base.HEX)
field("peer", "uint16", "Peer id")
field("tick_rate", "uint16", "Tick rate, Hz")
field("scene", "uint64", "Scene hash", base.HEX)
field("seed", "uint64", "Seed")
field("start", "int64", "Start, ns")
field("start_heard", "int64", "Start heard, ns")
field("task", "string", "Task")
field("length", "uint32", "Length, ms")
field("heard", "uint32", "Peers heard", base.HEX)
field("boot", "uint32", "Boot", base.HEX)
field("hand", "string", "Hand: mass kg, damping N s/m, stiffness N/m, friction N")
field("reason", "uint8", "Reason", base.DEC, reasons)
field("sealed", "bytes", "Sealed")
field("from", "uint8", "From peer")
field("to", "uint8", "To peer")
field("ephemeral", "bytes", "Ephemeral key")
field("mac1", "bytes", "First MAC")
field("mac2", "bytes", "Second MAC")

local short = ProtoExpert.new("hapnet.short", "The message is too short", expert.group.MALFORMED,
    expert.severity.ERROR)
hapnet.experts = { short }

-- Clocks differ by a constant: of each stream the least difference between arrival and sending is
-- taken for an age of 0.
local least = {}
function hapnet.init() least = {} end

local function age_ms(pinfo, sent)
    local stream = tostring(pinfo.src) .. ":" .. pinfo.src_port .. ">" .. tostring(pinfo.dst) .. ":"
        .. pinfo.dst_port
    local apart = tonumber(pinfo.abs_ts) * 1e3 - sent:tonumber() / 1e6
    if not pinfo.visited and (not least[stream] or apart < least[stream]) then
        least[stream] = apart
    end
    local age = apart - (least[stream] or apart)
    return math.floor(1e3 * age + 0.5) / 1e3
end

local function vector(range, read, format)
    local parts = {}
    for i = 0, 2 do parts[#parts + 1] = string.format(format or "%.6g", read(range, i)) end
    return table.concat(parts, " ")
end
local function floats(range) return vector(range, function(r, i) return r(4 * i, 4):le_float() end) end
local function sums(range)
    return vector(range, function(r, i) return r(4 * i, 4):le_uint() end, "%.0f")
end
local function steps(range, step)
    return vector(range, function(r, i) return step * r(2 * i, 2):le_int() end)
end

local function dissect_body(buffer, at, tree)
    local id = buffer(at, 2):le_uint()
    local turns = id >= 0x8000
    local size = turns and 94 or 50
    if buffer:len() < at + size then return nil end
    local body = tree:add(hapnet, buffer(at, size), "Body " .. id % 0x8000)
    body:add(f.body, buffer(at, 2), id % 0x8000)
    body:add(f.position, buffer(at + 2, 12), floats(buffer(at + 2, 12)))
    body:add(f.velocity, buffer(at + 14, 12), floats(buffer(at + 14, 12)))
    body:add(f.caused_displacement, buffer(at + 26, 12), sums(buffer(at + 26, 12)))
    body:add(f.caused_impulse, buffer(at + 38, 12), sums(buffer(at + 38, 12)))
    if turns then
        body:add_le(f.orientation, buffer(at + 50, 8))
        body:add(f.angular_velocity, buffer(at + 58, 12), floats(buffer(at + 58, 12)))
        body:add(f.caused_rotation, buffer(at + 70, 12), sums(buffer(at + 70, 12)))
        body:add(f.caused_angular_impulse, buffer(at + 82, 12), sums(buffer(at + 82, 12)))
    end
    return at + size
end

local function dissect_plain_state(buffer, tree)
    tree:add_le(f.flags, buffer(20, 1))
    tree:add_le(f.echo_of, buffer(22, 8))
    tree:add_le(f.echo_age, buffer(30, 4))
    tree:add(f.hip, buffer(34, 12), floats(buffer(34, 12)))
    tree:add(f.hip_velocity, buffer(46, 12), floats(buffer(46, 12)))
    tree:add(f.contact_force, buffer(58, 12), floats(buffer(58, 12)))
    tree:add(f.intention, buffer(70, 6), steps(buffer(70, 6), 1e-5))
    tree:add(f.intention_velocity, buffer(76, 6), steps(buffer(76, 6), 2e-4))
    tree:add_le(f.work, buffer(82, 4))
    local at = 86
    while at and at + 2 <= buffer:len() do at = dissect_body(buffer, at, tree) end
    if at ~= buffer:len() then tree:add_proto_expert_info(short) end
end

local function dissect_hello(buffer, tree)
    tree:add_le(f.flags, buffer(8, 1))
    tree:add_le(f.nonce, buffer(9, 4))
    tree:add_le(f.nonce_heard, buffer(13, 4))
    tree:add_le(f.peer, buffer(17, 2))
    tree:add_le(f.tick_rate, buffer(19, 2))
    tree:add_le(f.scene, buffer(21, 8))
    tree:add_le(f.seed, buffer(29, 8))
    tree:add_le(f.sent, buffer(37, 8))
    tree:add_le(f.echo_of, buffer(45, 8))
    tree:add_le(f.echo_age, buffer(53, 4))
    tree:add_le(f.start, buffer(57, 8))
    tree:add_le(f.start_heard, buffer(65, 8))
    tree:add(f.task, buffer(73, 16), buffer(73, 16):stringz())
    tree:add_le(f.length, buffer(89, 4))
    tree:add_le(f.heard, buffer(93, 4))
    tree:add_le(f.boot, buffer(97, 4))
    local hand = {}
    for i = 0, 3 do hand[#hand + 1] = string.format("%.6g", buffer(101 + 4 * i, 4):le_float()) end
    tree:add(f.hand, buffer(101, 16), table.concat(hand, " "))
end

local function dissect_handshake(buffer, kind, tree)
    local head = 12
    if kind == 0x88 then
        tree:add_le(f.key, buffer(4, 4)):set_text(
            string.format("Key of the sender: 0x%08x", buffer(4, 4):le_uint()))
        tree:add(f.from, buffer(8, 1))
        tree:add(f.to, buffer(9, 1))
    elseif kind == 0x89 then
        tree:add_le(f.key, buffer(4, 4))
    else
        tree:add_le(f.key, buffer(4, 4))
        tree:add(f.sealed, buffer(32))
        return
    end
    tree:add(f.ephemeral, buffer(head, 32))
    tree:add(f.sealed, buffer(head + 32, buffer:len() - head - 64))
    tree:add(f.mac1, buffer(buffer:len() - 32, 16))
    tree:add(f.mac2, buffer(buffer:len() - 16, 16))
end

local least_bytes = {
    [1] = 117, [2] = 86, [3] = 9, [0x81] = 137, [0x82] = 102, [0x83] = 29,
    [0x88] = 108, [0x89] = 96, [0x8a] = 64,
}

function hapnet.dissector(buffer, pinfo, root)
    pinfo.cols.protocol = "Hapnet"
    local kind = buffer(3, 1):uint()
    local tree = root:add(hapnet, buffer(), "Hapnet " .. (types[kind] or "message"))
    tree:add(f.version, buffer(2, 1))
    tree:add(f.type, buffer(3, 1))
    pinfo.cols.info = types[kind] or ("type " .. kind)
    if buffer(2, 1):uint() ~= 2 then
        pinfo.cols.info:append(", version " .. buffer(2, 1):uint())
        return
    end
    if not least_bytes[kind] or buffer:len() < least_bytes[kind] then
        tree:add_proto_expert_info(short)
        return
    end
    if kind >= 0x88 then return dissect_handshake(buffer, kind, tree) end
    local is_sealed = kind >= 0x80
    tree:add_le(is_sealed and f.key or f.session, buffer(4, 4))
    if kind % 0x80 == 2 then
        local age = age_ms(pinfo, buffer(12, 8):le_int64())
        tree:add_le(f.sequence, buffer(8, 4))
        tree:add_le(f.sent, buffer(12, 8))
        tree:add(f.age, buffer(12, 8), age):set_generated()
        pinfo.cols.info:append(string.format(" %d, age %.3f ms", buffer(8, 4):le_uint(), age))
        if is_sealed then tree:add(f.sealed, buffer(20)) else dissect_plain_state(buffer, tree) end
    elseif is_sealed then
        tree:add_le(f.number, buffer(8, 4))
        tree:add(f.sealed, buffer(12))
    elseif kind == 1 then
        dissect_hello(buffer, tree)
        pinfo.cols.info:append(" of peer " .. buffer(17, 2):le_uint())
    else
        tree:add(f.reason, buffer(8, 1))
        pinfo.cols.info:append(", " .. (reasons[buffer(8, 1):uint()] or "unknown reason"))
    end
end

local function recognize(buffer, pinfo, tree)
    if buffer:len() < 9 or buffer(0, 2):le_uint() ~= 0x4e48 then return false end
    if not types[buffer(3, 1):uint()] then return false end
    hapnet.dissector(buffer, pinfo, tree)
    return true
end
hapnet:register_heuristic("udp", recognize)

-- The emulator says what became of a packet in a comment of the capture.
local emulator = Proto("hapnet_emulator", "Hapnet's emulator")
local g = emulator.fields
g.fate = ProtoField.string("hapnet.fate", "Fate") -- "delayed" or "dropped" on arrival, or "left"
g.cause = ProtoField.string("hapnet.cause", "Cause of the drop")
g.delay_ms = ProtoField.double("hapnet.delay_ms", "Delay as drawn, ms")
g.copied = ProtoField.bool("hapnet.copied", "Copied")
g.corrupted_bits = ProtoField.uint32("hapnet.corrupted_bits", "Corrupted bits")
g.displaced = ProtoField.bool("hapnet.displaced", "Displaced")
g.late_us = ProtoField.uint32("hapnet.late_us", "Left late, us")
g.copy = ProtoField.bool("hapnet.copy", "Is a copy")
local comments = Field.new("frame.comment")
local in_ms = { us = 1e-3, ms = 1 }

local function show_fate(said, root)
    local delay, unit = said:match("^delayed ([%d.]+) (%a+)")
    local late, what = said:match("^late (%d+) us(.*)$")
    local cause = said:match("^dropped: ([%w-]+)$")
    if not (delay and in_ms[unit]) and not late and not cause then return end
    local fate = late and "left" or cause and "dropped" or "delayed"
    local tree = root:add(emulator, "Hapnet's emulator: " .. said)
    tree:add(g.fate, fate):set_generated()
    if cause then
        tree:add(g.cause, cause):set_generated()
    elseif late then
        tree:add(g.late_us, tonumber(late)):set_generated()
        tree:add(g.copy, what == ", copy"):set_generated()
    else
        tree:add(g.delay_ms, tonumber(delay) * in_ms[unit]):set_generated()
        tree:add(g.copied, said:find(", copied", 1, true) ~= nil):set_generated()
        tree:add(g.corrupted_bits, tonumber(said:match(", (%d+) bits? corrupted") or 0))
            :set_generated()
        tree:add(g.displaced, said:find(", displaced", 1, true) ~= nil):set_generated()
    end
end

function emulator.dissector(_, _, root)
    for _, comment in ipairs({ comments() }) do show_fate(tostring(comment.value), root) end
end
register_postdissector(emulator)
