// What the scatter pass is asked for.
#pragma once

namespace scarp {

enum class Terms { mass_momentum, force, all };

} // namespace scarp
