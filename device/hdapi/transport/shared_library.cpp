// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "device/hdapi/transport/shared_library.hpp"

#include "device/transport/shared_library.hpp"

#include <array>
#include <spdlog/fmt/fmt.h>

namespace hapnet::device::hdapi {

namespace {

constexpr std::array usual_names{"libHD.so", "libHD.so.3.4", "libHD.so.3.4.0", "libHD.so.3.0"};

} // namespace

Opened<Functions> load_library(const std::string& file)
{
    auto library = SharedLibrary::load(file, usual_names);
    if (!library) {
        return device_error(
            Fault::library_missing,
            fmt::format("cannot load libHD, the vendor's library ({}): install OpenHaptics "
                        "and the device's driver from 3D Systems, or say --hd-library FILE",
                        library.error().message));
    }
    Functions all;
    library->find(all.init_device, "hdInitDevice");
    library->find(all.disable_device, "hdDisableDevice");
    library->find(all.make_current_device, "hdMakeCurrentDevice");
    library->find(all.begin_frame, "hdBeginFrame");
    library->find(all.end_frame, "hdEndFrame");
    library->find(all.get_error, "hdGetError");
    library->find(all.get_error_string, "hdGetErrorString");
    library->find(all.enable, "hdEnable");
    library->find(all.disable, "hdDisable");
    library->find(all.get_booleans, "hdGetBooleanv");
    library->find(all.get_integers, "hdGetIntegerv");
    library->find(all.get_doubles, "hdGetDoublev");
    library->find(all.set_doubles, "hdSetDoublev");
    library->find(all.get_string, "hdGetString");
    library->find(all.check_calibration, "hdCheckCalibration");
    library->find(all.update_calibration, "hdUpdateCalibration");
    library->find(all.start_scheduler, "hdStartScheduler");
    library->find(all.stop_scheduler, "hdStopScheduler");
    library->find(all.set_scheduler_rate, "hdSetSchedulerRate");
    library->find(all.schedule_asynchronous, "hdScheduleAsynchronous");
    library->find(all.unschedule, "hdUnschedule");
    if (library->missing().empty()) return all;
    return device_error(
        Fault::library_missing,
        fmt::format("{} is no libHD that this program knows: it has no {}(); OpenHaptics "
                    "3.0 to 3.4 has it",
                    file.empty() ? "libHD.so" : file, library->missing()));
}

} // namespace hapnet::device::hdapi
