// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "emulator/core/loss/outage.hpp"

#include "proto/base/text.hpp"

#include <algorithm>
#include <spdlog/fmt/fmt.h>

namespace hapnet::emulator {

void WindowList::read(const base::Node& node, std::vector<Window>& target,
                      base::Reading& reading) const
{
    const auto* list = std::get_if<base::Node::List>(&node.value);
    if (list == nullptr) return complain_of(node, describe(), reading);
    target.clear();
    for (const base::Node& element : *list) {
        const auto* pair = std::get_if<base::Node::List>(&element.value);
        if (pair == nullptr || pair->size() != 2) return complain_of(element, describe(), reading);
        Window window;
        base::read_value((*pair)[0], window.from, reading);
        base::read_value((*pair)[1], window.to, reading);
        target.push_back(window);
    }
}

std::string WindowList::print(const std::vector<Window>& value) const
{
    std::vector<std::string> texts;
    for (const Window& window : value) {
        texts.push_back(
            fmt::format("[{}, {}]", base::value_text(window.from), base::value_text(window.to)));
    }
    return fmt::format("[{}]", base::list_text(texts));
}

base::Result<void> Outage::validate() const
{
    base::Duration last{0};
    for (const Window& window : windows) {
        const auto text = fmt::format("the outage from {} to {}", base::to_text(window.from),
                                      base::to_text(window.to));
        if (window.from >= window.to) return base::fail(text + " ends before it begins");
        if (window.from < last) {
            return base::fail(
                fmt::format("{} begins before {}: outages must ascend and not overlap", text,
                            base::to_text(last)));
        }
        last = window.to;
    }
    return {};
}

LossTheory Outage::theory(const Arrivals& arrivals) const
{
    // Datagram n arrives at n times the spacing. This counts the arrivals before a time.
    const auto count = static_cast<double>(arrivals.count);
    const auto before = [&](base::Duration time) {
        const auto whole = time / arrivals.spacing;
        const auto part = time % arrivals.spacing > base::Duration{0} ? 1 : 0;
        return std::min(static_cast<double>(whole + part), count);
    };
    double losses = 0.0;
    double runs = 0.0;
    for (const Window& window : windows) {
        const double lost = before(window.to) - before(window.from);
        losses += lost;
        if (lost > 0.0) runs += 1.0;
    }
    return theory_from_counts(count, losses, runs);
}

std::vector<LossProperty> Outage::properties(const RunFacts& /*facts*/) const
{
    return {Untestable{"losses depend on arrival times, which fates do not record"}};
}

bool Outage::Model::on_packet(const Packet& packet, const base::RandomStream& /*stream*/)
{
    const auto& outages = law_.windows.get();
    // After a change the next window may be far away.
    if (next_ < outages.size() && outages[next_].to <= packet.at) {
        const auto from = outages.begin() + static_cast<std::ptrdiff_t>(next_);
        const auto place = std::partition_point(
            from, outages.end(), [&](const Window& one) { return one.to <= packet.at; });
        next_ = static_cast<std::size_t>(place - outages.begin());
    }
    return next_ < outages.size() && outages[next_].from <= packet.at;
}

void Outage::Model::change(const Outage& law, const base::RandomStream& /*stream*/)
{
    if (law == law_) return;
    law_ = law;
    next_ = 0;
}

} // namespace hapnet::emulator
