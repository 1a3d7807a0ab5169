// Words, points, and which belongs to which: φ(θ) = lim w_θ1 … w_θk (math.md section 1).
#pragma once

#include <span>
#include <vector>

#include "system/system.h"

namespace ifsm::core {

// w_θ1 ∘ … ∘ w_θk. Letters are numbers of maps; a range error names the first that is none.
Affine word_map(const System& system, std::span<const std::int64_t> word);

// The point of the infinite address that is `word`, its last `period` letters repeated for ever: exact but for
// rounding. The letters must be those of active maps, 1 <= period <= length (range).
Vector3 point_of(const System& system, std::span<const std::int64_t> word, std::int64_t period);

// The words of that length whose pieces w_θ(A) the point lies in: all of those that are within `tolerance` of it, and
// none that is farther than twice that. In order of their letters. A limit error above `most` words, or when it takes
// too many pieces.
std::vector<std::vector<std::int64_t>> addresses_of(const System& system, const Vector3& point, std::int64_t length,
                                                    double tolerance, std::int64_t most);

}  // namespace ifsm::core
