// What `headrace doctor` tells of other programs that some of the work is done with. Without them the rest goes on, so
// that they warn at most.
#pragma once

#include "client/doctor.h"

namespace headrace::client {

Finding film_maker();      // ffmpeg, for --format mp4
Finding python_modules();  // pyzmq and NumPy of the python3 on the PATH, for the Python client

}  // namespace headrace::client
