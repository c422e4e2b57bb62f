// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "scene/rigid/hand_proxies.hpp"

#include "scene/rigid/hand_contacts.hpp"

#include <glm/geometric.hpp>

namespace hapnet::scene {

HandProxies::HandProxies(const WorldConfig& config)
    : proxies_{config.feels.any_friction()
                   ? config.hands.count * (touched_per_hand_max + config.planes.size())
                   : 0}
{}

void HandProxies::begin_step()
{
    for (std::size_t i = proxies_.size(); i-- > 0;) {
        if (proxies_[i].is_current) {
            proxies_[i].is_current = false;
        } else {
            proxies_.remove(i);
        }
    }
}

HandProxies::Proxy* HandProxies::find(const Touch& touch)
{
    for (Proxy& proxy : proxies_) {
        if (proxy.hand == touch.hand && proxy.other == touch.other) return &proxy;
    }
    return nullptr;
}

FrictionSpring HandProxies::begin(const Touch& touch, const HandFriction& limits)
{
    if (!limits.is_rough()) return {};
    Proxy* const proxy = find(touch);
    if (proxy == nullptr) {
        const bool has_room = proxies_.add({touch.hand, touch.other, true});
        return has_room ? FrictionSpring{.limits = limits} : FrictionSpring{};
    }
    proxy->is_current = true;
    if (!touch.overlaps) return {.limits = limits};
    const glm::dvec3 apart = touch.centre + proxy->offset - touch.axes * proxy->at;
    return {.limits = limits,
            .stretch = apart - glm::dot(apart, touch.normal) * touch.normal,
            .slides = proxy->slides};
}

void HandProxies::end(const Touch& touch, const FrictionSpring& friction)
{
    Proxy* const proxy = find(touch);
    if (proxy == nullptr) return;
    proxy->slides = friction.slides;
    proxy->at = (touch.point - friction.stretch + friction.slid) * touch.axes;
    proxy->offset = touch.point - touch.centre;
}

void HandProxies::forget(PartId part)
{
    for (std::size_t i = proxies_.size(); i-- > 0;) {
        if (proxies_[i].other == part) proxies_.remove(i);
    }
}

} // namespace hapnet::scene
