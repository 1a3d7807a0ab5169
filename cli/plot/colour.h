// Colours that readers of any colour vision tell apart: the palette of Okabe and Ito, and viridis.
#pragma once

namespace plot {

struct Colour {
  double red = 0, green = 0, blue = 0;  // 0 … 1
};

Colour mix(Colour a, Colour b, double share_of_b);

namespace palette {
inline constexpr Colour ink{0.13, 0.13, 0.15};
inline constexpr Colour faint{0.88, 0.88, 0.89};
inline constexpr Colour muted{0.62, 0.62, 0.64};
inline constexpr Colour land{0.95, 0.93, 0.88};
inline constexpr Colour blue{0.00, 0.45, 0.70};
inline constexpr Colour orange{0.84, 0.37, 0.00};
inline constexpr Colour green{0.00, 0.62, 0.45};
inline constexpr Colour paper{1, 1, 1};
}  // namespace palette

// Dark violet at 0 to yellow at 1; lightness grows evenly. Outside 0 … 1 the ends.
Colour viridis(double share);

}  // namespace plot
