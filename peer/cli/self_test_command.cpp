// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "device/rig.hpp"
#include "peer/cli/chosen_device.hpp"
#include "peer/cli/commands.hpp"
#include "peer/loop/force_gate.hpp"
#include "peer/loop/watchdog.hpp"
#include "peer/loop/watched_rig.hpp"
#include "peer/loop/zero_force.hpp"
#include "peer/self_test/report.hpp"
#include "peer/self_test/self_test.hpp"
#include "proto/base/fields_json.hpp"
#include "proto/disk/result_file.hpp"
#include "proto/net/clock.hpp"
#include "proto/net/crash_signal.hpp"
#include "proto/net/program.hpp"
#include "proto/net/real_time.hpp"
#include "proto/net/stop_signal.hpp"
#include "proto/net/wait.hpp"
#include "scene/description.hpp"

#include <algorithm>
#include <array>
#include <atomic>
#include <chrono>
#include <future>
#include <spdlog/fmt/fmt.h>

namespace hapnet::peer {

namespace {

using namespace std::chrono_literals;
using self_test::Prompt;
using self_test::SelfTest;

constexpr int test_priority = 45; // same as the loop of a session
constexpr base::Duration test_tick = 1ms;
constexpr base::Duration prompts_shown_every = 50ms;
constexpr int ticks_after_the_end = 60; // long enough for the governor to fade out
constexpr base::Duration gone_after_a_stop = 800ms;

/// The loop of the test, at the pace of the device if it sets one, and the data that another thread
/// sees. It has a watchdog like that of a session, because the self-test exerts the first force of
/// a device.
class TestLoop {
public:
    TestLoop(SelfTest& test, device::Rig& rig, loop::Watchdog& watchdog, loop::ForceGate& gate)
        : test_{test}, rig_{rig}, watchdog_{watchdog}, gate_{gate}
    {}

    void run()
    {
        const net::CrashStack stack;
        const loop::ZeroForceAtTheEnd zero{rig_.device(), watchdog_};
        std::ignore = net::request_real_time(test_priority);
        if (rig_.device().capabilities().pacing == device::Pacing::device) {
            rig_.device().pace([this] { return tick(), !is_over(); });
        }
        // The loop runs at its own pace, even after a device has stopped setting one.
        base::TimePoint due = net::monotonic_now();
        while (!is_over()) {
            due = std::max(due + test_tick, net::monotonic_now());
            net::sleep_until(due);
            tick();
        }
    }
    [[nodiscard]] Prompt prompt() const { return prompt_.load(std::memory_order_relaxed); }

private:
    [[nodiscard]] bool is_over() const { return ticks_left_ == 0 || watchdog_.is_dying(); }

    void tick()
    {
        const base::TimePoint now = net::monotonic_now();
        watchdog_.beat(now);
        loop::WatchedRig watched{rig_, watchdog_, &gate_};
        if (watchdog_.take_fault()) {
            rig_.governor().latch({device::Fault::timeout, device::Trip::loop});
        }
        const device::Sample& sample = watched.read(now);
        self_test::StepRequest request{.is_done = true};
        if (!is_ending_ && !gate_.is_stopping()) {
            request = test_.on_tick({sample, rig_.calibration(), applied_}, now);
        }
        if (watchdog_.is_dying()) return;
        applied_ = watched.apply(request.wanted, request.permitted, now);
        prompt_.store(request.prompt, std::memory_order_relaxed);
        if (request.is_done) is_ending_ = true;
        if (is_ending_) --ticks_left_;
    }

    SelfTest& test_;
    device::Rig& rig_;
    loop::Watchdog& watchdog_;
    loop::ForceGate& gate_;
    base::Force applied_;
    bool is_ending_ = false;
    int ticks_left_ = ticks_after_the_end;
    std::atomic<Prompt> prompt_{Prompt::nothing};
};

/// Shows the instructions for the person until the loop has ended. SIGINT and SIGTERM end it.
void accompany(TestLoop& loop, const net::StopSignal& stop)
{
    auto ended = std::async(std::launch::async, [&loop] { loop.run(); });
    Prompt shown = Prompt::nothing;
    while (ended.wait_for(0ms) != std::future_status::ready) {
        const std::array descriptors{stop.descriptor()};
        net::wait_readable(stop.requested() ? std::span<const int>{} : descriptors,
                           net::monotonic_now() + prompts_shown_every);
        const Prompt prompt = loop.prompt();
        if (prompt == shown) continue;
        shown = prompt;
        if (prompt != Prompt::nothing) net::say("hapnet-peer", self_test::describe(prompt));
    }
    ended.get();
}

/// Stores the results that later sessions need.
void note_result(device_state::KeptDevice& kept, const SelfTest& test, double heat)
{
    kept.on_rest(heat);
    if (!self_test::has_passed(test)) return;
    if (self_test::has_shown_force(test)) return kept.on_passed();
    net::say("hapnet-peer", "the force step was not done: a session with this device still needs "
                            "--untested-device");
}

/// Returns the notes about contacts that a session with the paper's scene would print.
std::string stiffness_of_a_session(const DeviceChoice& choice,
                                   const device::Capabilities& capabilities)
{
    if (!choice.is_real()) return "";
    return note_on_stiffness(capabilities, mount_of(choice, capabilities),
                             scene::paper_scene().hands.stiffness_n_per_m);
}

} // namespace

base::Result<int> run(const SelfTestCommand& command)
{
    std::optional<disk::ResultFile> file;
    if (command.json) file.emplace(*command.json);
    const net::StopSignal stop; // must exist before any thread starts
    stop.enforce(gone_after_a_stop, net::exit_environment);
    const net::CrashSignal crash;
    const net::CrashStack stack;
    auto opened = open_chosen(command.device, device::Task::p1);
    if (!opened) {
        net::say("hapnet-peer", describe_open_error(command.device, opened.error()));
        return net::exit_environment;
    }
    const auto& capabilities = (*opened)->capabilities();
    const std::string softer = stiffness_of_a_session(command.device, capabilities);
    SelfTest test{{.capabilities = capabilities,
                   .is_real = command.device.is_real(),
                   .read_for = command.read_for,
                   .skip = command.skip}};
    // The rig uses the device's own frame, without a mount, because there is no scene.
    auto kept = kept_of(command.device, **opened);
    device::GovernorLimits limits{.checks_motion = command.device.is_real()};
    if (kept) {
        limits.heat_start = kept->heat_at_start(limits.heat_time);
        kept->on_use();
    }
    device::Rig rig{*std::move(opened), limits};
    net::say("hapnet-peer", device::description(rig.device()));
    if (!softer.empty()) net::say("hapnet-peer", "in a session: " + softer);
    // A simulated person takes the stylus out of its inkwell at the cue, and needs no instructions.
    if (command.device.is_simulated()) {
        rig.device().on_cue({.start = net::monotonic_now(), .hands_on = {}, .seed = base::Seed{}});
    }
    loop::Watchdog watchdog{rig.device(), &crash};
    loop::ForceGate gate{stop};
    TestLoop loop{test, rig, watchdog, gate};
    accompany(loop, stop);
    if (kept) note_result(*kept, test, rig.governor().heat());
    test.stop();
    net::print(self_test::report_text(rig.device(), test));
    if (file) file->commit(base::json_of(self_test::report_of(rig.device(), test)).dump(2) + "\n");
    return self_test::has_passed(test) ? 0 : net::exit_failed;
}

} // namespace hapnet::peer
