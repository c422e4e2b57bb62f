// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "device/simulated/keys.hpp"

#include "proto/base/text.hpp"

#include <spdlog/fmt/fmt.h>

namespace hapnet::device {

namespace {

/// What stands at a key is not between `least` and `most`, as they are to be said.
void complain_of_range(const base::Node& node, std::string_view least, std::string_view most,
                       base::Reading& reading)
{
    reading.complain(node.place, fmt::format("{} is out of range: {} to {} is possible here",
                                             base::what_it_is(node), least, most));
}

} // namespace

void KeyReader::value(std::string_view key, double& target, const Range& range)
{
    const base::Node* node = table_.find(key);
    if (node == nullptr) return;
    double read = target;
    base::read_quantity(
        *node, read, [&](std::string_view text) { return base::parse_quantity(text, range.kind); },
        table_.reading());
    if (!table_.reading().is_good()) return;
    if (!(read >= range.least && read <= range.most)) {
        return complain_of_range(*node, base::quantity_text(range.least, range.kind),
                                 base::quantity_text(range.most, range.kind), table_.reading());
    }
    target = read;
}

void KeyReader::value(std::string_view key, double& target, const Plain& range)
{
    const base::Node* node = table_.find(key);
    if (node == nullptr) return;
    double read = target;
    base::read_value(*node, read, table_.reading());
    if (!(read >= range.least && read <= range.most)) {
        return complain_of_range(*node, fmt::to_string(range.least), fmt::to_string(range.most),
                                 table_.reading());
    }
    target = read;
}

void KeyReader::value(std::string_view key, base::Duration& target, const Times& range)
{
    const base::Node* node = table_.find(key);
    if (node == nullptr) return;
    base::Duration read = target;
    base::read_value(*node, read, table_.reading());
    if (!table_.reading().is_good()) return;
    if (read < range.least || read > range.most) {
        return complain_of_range(*node, base::to_text(range.least), base::to_text(range.most),
                                 table_.reading());
    }
    target = read;
}

void KeyReader::value(std::string_view key, base::Probability& target)
{
    if (const base::Node* node = table_.find(key))
        base::read_value(*node, target, table_.reading());
}

void KeyPrinter::line(std::string_view key, const std::string& value)
{
    text_ += fmt::format("{}{} = {}\n", prefix_, key, value);
}

void KeyPrinter::value(std::string_view key, double value, const Range& range)
{
    line(key, base::quoted(base::quantity_text(value, range.kind)));
}

void KeyPrinter::value(std::string_view key, double value, const Plain& /*range*/)
{
    line(key, base::value_text(value));
}

void KeyPrinter::value(std::string_view key, base::Duration value, const Times& /*range*/)
{
    line(key, base::value_text(value));
}

void KeyPrinter::value(std::string_view key, base::Duration value, base::Duration /*most*/)
{
    line(key, base::value_text(value));
}

void KeyPrinter::value(std::string_view key, base::Probability value)
{
    line(key, base::value_text(value));
}

} // namespace hapnet::device
