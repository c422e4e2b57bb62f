// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "tests/support/hid/pid_descriptor.hpp"

#include <algorithm>
#include <initializer_list>
#include <iterator>

namespace hapnet::hid_double {

namespace {

// The items of the standard: USB HID 1.11, 6.2.2. The value of each has its own size.
constexpr unsigned page = 0x04;
constexpr unsigned usage = 0x08;
constexpr unsigned usage_min = 0x18;
constexpr unsigned usage_max = 0x28;
constexpr unsigned logical_min = 0x14;
constexpr unsigned logical_max = 0x24;
constexpr unsigned physical_min = 0x34;
constexpr unsigned physical_max = 0x44;
constexpr unsigned exponent = 0x54;
constexpr unsigned unit = 0x64;
constexpr unsigned size = 0x74;
constexpr unsigned count = 0x94;
constexpr unsigned report_id = 0x84;
constexpr unsigned collection = 0xa0;
constexpr unsigned input = 0x80;
constexpr unsigned output = 0x90;
constexpr unsigned feature = 0xb0;
constexpr unsigned end = 0xc0;

constexpr int application = 1;
constexpr int logical = 2;
constexpr int array = 0;
constexpr int constant = 3;
constexpr int variable = 2;

class Writer {
public:
    Writer& say(unsigned item, long value)
    {
        // Only the values of ranges have a sign.
        const bool is_range = item == logical_min || item == logical_max || item == physical_min ||
                              item == physical_max || item == exponent;
        const long byte_max = is_range ? 127 : 255;
        const long word_max = is_range ? 32767 : 65535;
        unsigned code = 1;
        if (value < -128 || value > byte_max) code = 2;
        if (value < -32768 || value > word_max) code = 3;
        bytes_.push_back(static_cast<std::byte>(item | code));
        const auto bits = static_cast<unsigned long>(value);
        const unsigned length = code == 3 ? 4 : code;
        for (unsigned i = 0; i < length; ++i) {
            bytes_.push_back(static_cast<std::byte>((bits >> (8 * i)) & 0xffU));
        }
        return *this;
    }
    Writer& say_end()
    {
        bytes_.push_back(std::byte{end});
        return *this;
    }
    /// Opens a collection, with this usage before it.
    Writer& open(unsigned its_usage, int kind)
    {
        return say(usage, its_usage).say(collection, kind);
    }
    /// Adds values of `bits` bits from `low` to `high`.
    Writer& values(unsigned kind, int bits, int how_many, int flags)
    {
        return say(size, bits).say(count, how_many).say(kind, flags);
    }
    Writer& range(long low, long high) { return say(logical_min, low).say(logical_max, high); }
    Writer& choices(std::initializer_list<unsigned> usages)
    {
        for (const unsigned one : usages) say(usage, one);
        return *this;
    }
    Writer& block_index(unsigned kind)
    {
        return say(usage, 0x22).range(1, 40).values(kind, 8, 1, variable);
    }
    Writer& effect_types(unsigned kind)
    {
        open(0x25, logical)
            .choices({0x26, 0x27, 0x30, 0x31, 0x32, 0x33, 0x34, 0x40, 0x41, 0x42, 0x43})
            .range(1, 11);
        return values(kind, 8, 1, array).say_end();
    }

    [[nodiscard]] std::vector<std::byte> bytes() const { return bytes_; }

private:
    std::vector<std::byte> bytes_;
};

void say_inputs(Writer& writer, ReportIds ids)
{
    writer.say(report_id, ids.input()).say(page, 0x09).say(usage_min, 1).say(usage_max, 16);
    writer.range(0, 1).values(input, 1, 16, variable);
    writer.say(page, 0x01).choices({0x30, 0x31, 0x32, 0x33, 0x34, 0x35});
    writer.range(-32767, 32767).values(input, 16, 6, variable);

    writer.say(page, 0x0f).open(0x92, logical).say(report_id, ids.state());
    writer.choices({0x9f, 0xa0, 0xa4, 0xa6, 0x94}).range(0, 1).values(input, 1, 5, variable);
    writer.values(input, 3, 1, constant).say_end();
}

void say_set_effect(Writer& writer, ReportIds ids)
{
    writer.open(0x21, logical).say(report_id, ids.set_effect());
    writer.block_index(output).effect_types(output);
    writer.choices({0x50, 0x54, 0x51, 0xa7}).range(0, 32767).say(physical_min, 0);
    writer.say(physical_max, 32767).say(unit, 0x1003).say(exponent, -3);
    writer.values(output, 16, 4, variable).say(unit, 0).say(exponent, 0);
    writer.say(usage, 0x52).range(0, 255).say(physical_max, 10000);
    writer.values(output, 8, 1, variable);
    writer.say(usage, 0x53).range(1, 8).values(output, 8, 1, variable);
    writer.open(0x55, logical).say(page, 0x01).choices({0x30, 0x31}).range(0, 1);
    writer.values(output, 1, 2, variable).say_end();
    writer.say(page, 0x0f).say(usage, 0x56).values(output, 1, 1, variable);
    writer.values(output, 5, 1, constant);
    writer.open(0x57, logical).choices({0x000a'0001, 0x000a'0002}).range(0, 36000);
    writer.values(output, 16, 2, variable).say_end().say_end();
}

void say_playing(Writer& writer, ReportIds ids)
{
    writer.open(0x73, logical).say(report_id, ids.set_constant_force()).block_index(output);
    writer.say(usage, 0x70).range(-32767, 32767).values(output, 16, 1, variable).say_end();

    writer.open(0x77, logical).say(report_id, ids.effect_operation()).block_index(output);
    writer.open(0x78, logical).choices({0x79, 0x7a, 0x7b}).range(1, 3);
    writer.values(output, 8, 1, array).say_end();
    writer.say(usage, 0x7c).range(0, 255).values(output, 8, 1, variable).say_end();

    writer.open(0x90, logical).say(report_id, ids.block_free()).block_index(output).say_end();

    writer.open(0x95, logical).say(report_id, ids.device_control()).open(0x96, logical);
    writer.choices({0x97, 0x98, 0x99, 0x9a, 0x9b, 0x9c}).range(1, 6);
    writer.values(output, 1, 8, variable).say_end().say_end();

    writer.open(0x7d, logical).say(report_id, ids.device_gain()).say(usage, 0x7e).range(0, 255);
    writer.values(output, 8, 1, variable).say_end();
}

void say_loading(Writer& writer, ReportIds ids)
{
    writer.open(0xab, logical).say(report_id, ids.create_new_effect()).effect_types(feature);
    writer.say(page, 0x01).say(usage, 0x3b).range(0, 511).values(feature, 10, 1, variable);
    writer.values(feature, 6, 1, constant).say_end().say(page, 0x0f);

    writer.open(0x89, logical).say(report_id, ids.block_load()).block_index(feature);
    writer.open(0x8b, logical).choices({0x8c, 0x8d, 0x8e}).range(1, 3);
    writer.values(feature, 8, 1, array).say_end();
    writer.say(usage, 0xac).range(0, 65535).values(feature, 16, 1, variable).say_end();

    writer.open(0x7f, logical).say(report_id, ids.pool()).say(usage, 0x80);
    writer.values(feature, 16, 1, variable).say(usage, 0x83).range(0, 255);
    writer.values(feature, 8, 1, variable).choices({0xa9, 0xaa}).range(0, 1);
    writer.values(feature, 1, 2, variable).values(feature, 6, 1, constant).say_end();
}

} // namespace

std::vector<std::byte> pid_descriptor(ReportIds ids)
{
    Writer writer;
    writer.say(page, 0x01).open(0x04, application);
    say_inputs(writer, ids);
    say_set_effect(writer, ids);
    say_playing(writer, ids);
    say_loading(writer, ids);
    return writer.say_end().bytes();
}

std::vector<std::byte> spacemouse_descriptor()
{
    Writer writer;
    writer.say(page, 0x01).open(0x08, application);
    for (const unsigned first : {0x30U, 0x33U}) {
        writer.say(collection, 0).say(report_id, first == 0x30U ? 1 : 2);
        writer.choices({first, first + 1, first + 2}).range(-350, 350);
        writer.values(input, 16, 3, variable).say_end();
    }
    writer.say(report_id, 3).say(page, 0x09).say(usage_min, 1).say(usage_max, 2).range(0, 1);
    writer.values(input, 1, 2, variable).values(input, 14, 1, constant);
    return writer.say_end().bytes();
}

std::vector<std::byte> mouse_descriptor()
{
    return bytes_of({0x05, 0x01, 0x09, 0x02, 0xa1, 0x01, 0x09, 0x01, 0xa1, 0x00, 0x05, 0x09, 0x19,
                     0x01, 0x29, 0x03, 0x15, 0x00, 0x25, 0x01, 0x95, 0x03, 0x75, 0x01, 0x81, 0x02,
                     0x95, 0x01, 0x75, 0x05, 0x81, 0x01, 0x05, 0x01, 0x09, 0x30, 0x09, 0x31, 0x15,
                     0x81, 0x25, 0x7f, 0x75, 0x08, 0x95, 0x02, 0x81, 0x06, 0xc0, 0xc0});
}

std::vector<std::byte> bytes_of(const std::vector<unsigned>& values)
{
    std::vector<std::byte> bytes;
    std::transform(values.begin(), values.end(), std::back_inserter(bytes),
                   [](unsigned value) { return static_cast<std::byte>(value); });
    return bytes;
}

} // namespace hapnet::hid_double
