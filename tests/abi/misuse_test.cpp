// The misuse matrix: every function of the ABI, every parameter, everything that can be wrong with it. Each wrong call
// must answer with the right status, name itself and the argument in the error record, and leave its outputs alone.
// The functions come from functions.csv; the test abi.tables fails when one is missing there.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <functional>
#include <limits>
#include <random>
#include <set>
#include <sstream>

#include "world.h"

using namespace misuse;

namespace {

constexpr std::int64_t least = std::numeric_limits<std::int64_t>::min();
constexpr std::int64_t most = std::numeric_limits<std::int64_t>::max();
constexpr std::int64_t beyond_memory = std::int64_t{1} << 61;
constexpr double infinity = std::numeric_limits<double>::infinity();
constexpr double nan = std::numeric_limits<double>::quiet_NaN();
constexpr std::uint32_t seed = 20260101;

using Statuses = std::set<ifsm_status>;
const Statuses bad_number = {IFSM_ERROR_RANGE, IFSM_ERROR_LIMIT};
const Statuses bad_count = {IFSM_ERROR_RANGE, IFSM_ERROR_LIMIT, IFSM_ERROR_SHAPE, IFSM_ERROR_CAPACITY};

World& world() {
  static World the_world;
  return the_world;
}

ifsm_error last_error() {
  ifsm_error error{};
  error.struct_size = sizeof error;
  EXPECT_EQ(ifsm_last_error(&error), IFSM_OK);
  return error;
}

// "points" is named by "points", "curve.points" and "curves[0].points".
bool names(const std::string& told, const std::string& argument) {
  if (told == argument) return true;
  return told.size() > argument.size() + 1 && told.ends_with(argument) &&
         told[told.size() - argument.size() - 1] == '.';
}

// Runs a call that is wrong in one thing.
void expect_refused(Call& call, const Statuses& expected, const std::set<std::string>& arguments,
                    const std::string& wrong) {
  const std::string& name = call.function().name;
  const ifsm_error before = last_error();
  call.fill();
  const ifsm_status status = call.run();
  std::ostringstream what;
  what << name << " with " << wrong << " answered " << ifsm_status_name(status);
  EXPECT_TRUE(expected.contains(status)) << what.str();
  EXPECT_TRUE(call.untouched()) << what.str() << " and touched its outputs";
  if (status == IFSM_OK) return call.forget_handles();
  const ifsm_error error = last_error();
  if (name == "ifsm_last_error") {  // it tells about others, never about itself
    EXPECT_EQ(error.status, before.status) << what.str();
    return;
  }
  EXPECT_EQ(error.status, status) << what.str();
  EXPECT_EQ(error.function, name) << what.str();
  EXPECT_TRUE(std::any_of(arguments.begin(), arguments.end(),
                          [&](const std::string& argument) { return names(error.argument, argument); }))
      << what.str() << " and blames '" << error.argument << "': " << error.message;
  EXPECT_GT(std::strlen(error.message), 20U) << what.str() << " and says only: " << error.message;
}

void expect_taken(Call& call, const std::string& what) {
  const ifsm_status status = call.run();
  EXPECT_EQ(status, IFSM_OK) << call.function().name << " with " << what << ": " << last_error().message;
  EXPECT_TRUE(call.guards_stand()) << call.function().name << " with " << what;
  if (status == IFSM_OK) call.forget_handles();
}

// Options that say something else may want other sizes: then the arrays of the right call are refused, and nothing
// else.
void expect_understood(Call& call, const std::string& what) {
  call.fill();
  const ifsm_status status = call.run();
  if (status != IFSM_ERROR_CAPACITY) return expect_taken(call, what);
  EXPECT_TRUE(call.untouched()) << call.function().name << " with " << what;
}

// visit(function, index, parameter) for every parameter of one of the kinds.
void for_each(const std::set<std::string>& kinds,
              const std::function<void(const Function&, std::size_t, const Parameter&)>& visit) {
  for (const Function& function : functions()) {
    if (!function.can_fail) continue;
    for (std::size_t i = 0; i < function.parameters.size(); ++i)
      if (kinds.contains(function.parameters[i].kind)) visit(function, i, function.parameters[i]);
  }
}

std::string text(const Parameter& parameter, const std::string& wrong) { return parameter.name + " " + wrong; }

void every_right_call_succeeds() {
  for (const Function& function : functions()) {
    Call call(world(), function);
    expect_taken(call, "right arguments");
  }
}

TEST(Misuse, StartsFromCallsThatSucceed) { every_right_call_succeeds(); }

TEST(Misuse, NullPointersAreRefusedOrHaveAMeaning) {
  for_each({"handle_out", "struct_in",  "options_in", "options_out", "struct_out", "doubles_in", "ints_in",
            "int64s_in",  "bytes_in",   "uints_in",   "doubles_out", "ints_out",   "uints_out",  "bytes_out",
            "count_out",  "double_out", "int_out",    "string",      "name",       "callback",   "user"},
           [](const Function& function, std::size_t i, const Parameter& parameter) {
             Call call(world(), function);
             call[i].pointer = nullptr;
             if (parameter.null == "allowed")
               expect_understood(call, text(parameter, "NULL"));
             else  // an output array with a capacity, too
               expect_refused(call, {IFSM_ERROR_NULL}, {parameter.name}, text(parameter, "NULL"));
           });
}

TEST(Misuse, NullHandlesAreRefusedExceptByDestroy) {
  for_each({"handle"}, [](const Function& function, std::size_t i, const Parameter& parameter) {
    Call call(world(), function);
    const std::uint64_t fresh = call[i].id;
    call[i].id = 0;
    if (parameter.null == "allowed")
      expect_taken(call, text(parameter, "{0}"));
    else
      expect_refused(call, {IFSM_ERROR_INVALID_HANDLE}, {parameter.name}, text(parameter, "{0}"));
    call[i].id = fresh;
  });
}

TEST(Misuse, StaleAndTwiceDestroyedHandlesAreRefused) {
  for_each({"handle"}, [](const Function& function, std::size_t i, const Parameter& parameter) {
    const std::uint64_t stale = world().fresh(parameter.type);
    ASSERT_EQ(World::destroy(parameter.type, stale), IFSM_OK);
    const std::uint64_t next = world().fresh(parameter.type);  // may live in the same slot
    Call call(world(), function);
    const std::uint64_t fresh = call[i].id;
    call[i].id = stale;
    expect_refused(call, {IFSM_ERROR_INVALID_HANDLE}, {parameter.name}, text(parameter, "destroyed"));
    call[i].id = fresh;
    EXPECT_NE(stale, next);
    EXPECT_EQ(World::destroy(parameter.type, next), IFSM_OK);
  });
}

TEST(Misuse, HandlesOfAnotherKindAreRefused) {
  for_each({"handle"}, [](const Function& function, std::size_t i, const Parameter& parameter) {
    Call call(world(), function);
    const std::uint64_t fresh = call[i].id;
    for (const auto& [type, id] : world().ids()) {
      if (type == parameter.type) continue;
      call[i].id = id;
      expect_refused(call, {IFSM_ERROR_INVALID_HANDLE}, {parameter.name}, text(parameter, "a handle of " + type));
    }
    call[i].id = fresh;
  });
  every_right_call_succeeds();  // nothing was destroyed by a wrong name
}

TEST(Misuse, AHundredThousandForgedHandlesAreRefused) {
  constexpr int forgeries = 100'000;
  int parameters = 0;
  for_each({"handle"}, [&](const Function&, std::size_t, const Parameter&) { ++parameters; });
  const int each = forgeries / parameters + 1;
  std::mt19937_64 random(seed);
  for_each({"handle"}, [&](const Function& function, std::size_t i, const Parameter& parameter) {
    Call call(world(), function);
    const std::uint64_t fresh = call[i].id;
    std::set<std::uint64_t> live = {fresh, world().refuted()};
    for (const auto& entry : world().ids()) live.insert(entry.second);
    const std::uint64_t model = *std::next(live.begin(), static_cast<std::ptrdiff_t>(random() % live.size()));
    for (int k = 0; k < each; ++k) {
      std::uint64_t forged = random();  // any bits; or a live handle with one to three bits flipped, or moved a little
      if (k % 3 == 1) {
        forged = model;
        for (std::uint64_t flips = random() % 3 + 1; flips > 0; --flips) forged ^= std::uint64_t{1} << random() % 64;
      } else if (k % 3 == 2) {
        forged = model + random() % 512 - 256;
      }
      if (forged == 0 || live.contains(forged)) continue;
      call[i].id = forged;
      expect_refused(call, {IFSM_ERROR_INVALID_HANDLE}, {parameter.name}, text(parameter, std::to_string(forged)));
      if (testing::Test::HasFailure()) break;  // one is enough
    }
    call[i].id = fresh;
  });
  every_right_call_succeeds();
}

TEST(Misuse, NumbersOutsideTheirRangeAreRefused) {
  for_each({"enum", "integer"}, [](const Function& function, std::size_t i, const Parameter& parameter) {
    const bool wide = parameter.type == "int64_t";
    const std::int64_t low = world().number(parameter.low);
    const std::int64_t high = world().number(parameter.high);
    for (const std::int64_t value : {low - 1, wide ? least : INT32_MIN, high + 1, wide ? most : INT32_MAX}) {
      Call call(world(), function);
      call[i].integer = value;
      expect_refused(call, bad_number, {parameter.name}, text(parameter, std::to_string(value)));
    }
  });
}

TEST(Misuse, DoublesThatAreNotFiniteOrOutsideAreRefused) {
  for_each({"double"}, [](const Function& function, std::size_t i, const Parameter& parameter) {
    Call call(world(), function);
    for (const double value : {nan, infinity, -infinity}) {
      call[i].real = value;
      expect_refused(call, {IFSM_ERROR_NOT_FINITE}, {parameter.name}, text(parameter, std::to_string(value)));
    }
    if (parameter.low == "any") return;  // every finite number means something
    for (const double value : {std::stod(parameter.low) - 0.5, std::stod(parameter.high) + 0.5, 1e308, -1e308}) {
      call[i].real = value;
      expect_refused(call, {IFSM_ERROR_RANGE}, {parameter.name}, text(parameter, std::to_string(value)));
    }
  });
}

TEST(Misuse, ArraysWithOneBadElementAreRefusedWithItsIndex) {
  for_each({"doubles_in"}, [](const Function& function, std::size_t i, const Parameter& parameter) {
    Call call(world(), function);
    for (const std::int64_t at : {std::int64_t{0}, call.elements(i) / 2, call.elements(i) - 1}) {
      auto* element = reinterpret_cast<double*>(call.buffer(i).data()) + at;
      const double good = *element;
      for (const double value : {nan, infinity, -infinity}) {
        *element = value;
        expect_refused(call, {IFSM_ERROR_NOT_FINITE}, {parameter.name},
                       text(parameter, "that hold " + std::to_string(value)));
        EXPECT_EQ(last_error().index, at) << function.name << ", " << parameter.name;
        EXPECT_FALSE(std::isfinite(last_error().value)) << function.name << ", " << parameter.name;
      }
      if (!parameter.high.empty()) {
        *element = std::stod(parameter.high) + 0.5;
        expect_refused(call, {IFSM_ERROR_RANGE}, {parameter.name},
                       text(parameter, "that hold " + std::to_string(*element)));
        EXPECT_EQ(last_error().index, at) << function.name << ", " << parameter.name;
        EXPECT_EQ(last_error().value, *element) << function.name << ", " << parameter.name;
      }
      *element = good;
    }
  });
  for_each({"ints_in"}, [](const Function& function, std::size_t i, const Parameter& parameter) {
    Call call(world(), function);
    for (std::int64_t at = 0; at < call.elements(i); ++at) {
      auto* element = reinterpret_cast<std::int32_t*>(call.buffer(i).data()) + at;
      const std::int32_t good = *element;
      for (const std::int64_t value : {world().number(parameter.low) - 1, world().number(parameter.high) + 1}) {
        *element = static_cast<std::int32_t>(value);
        expect_refused(call, {IFSM_ERROR_RANGE}, {parameter.name},
                       text(parameter, "that hold " + std::to_string(value)));
        EXPECT_EQ(last_error().index, at) << function.name << ", " << parameter.name;
      }
      *element = good;
    }
  });
}

TEST(Misuse, ArraysOfWideIntegersWithOneBadElementAreRefusedWithItsIndex) {
  for_each({"int64s_in"}, [](const Function& function, std::size_t i, const Parameter& parameter) {
    Call call(world(), function);
    for (std::int64_t at = 0; at < call.elements(i); ++at) {
      auto* element = reinterpret_cast<std::int64_t*>(call.buffer(i).data()) + at;
      const std::int64_t good = *element;
      for (const std::int64_t value :
           {world().number(parameter.low) - 1, world().number(parameter.high) + 1, least, most}) {
        *element = value;
        expect_refused(call, {IFSM_ERROR_RANGE}, {parameter.name},
                       text(parameter, "that hold " + std::to_string(value)));
        EXPECT_EQ(last_error().index, at) << function.name << ", " << parameter.name;
      }
      *element = good;
    }
  });
}

TEST(Misuse, CountsThatCannotBeAreRefused) {
  for_each({"count"}, [](const Function& function, std::size_t i, const Parameter& parameter) {
    const std::set<std::string> either = {parameter.name, function.parameters[i - 1].name};
    for (const std::int64_t count : {std::int64_t{-1}, least, most, beyond_memory}) {
      Call call(world(), function);
      call[i].integer = count;
      std::set<std::string> blamed = either;  // or the output array, when that became too small first
      for (const Parameter& other : function.parameters)
        if (is_array_out(other.kind) && count > 0) blamed.insert(other.name);
      expect_refused(call, bad_count, blamed, text(parameter, std::to_string(count)));
    }
  });
}

TEST(Misuse, ACountThatDoesNotFitIsRefusedWithTheOneThatDoes) {
  for_each({"count"}, [](const Function& function, std::size_t i, const Parameter& parameter) {
    for (const std::int64_t count : {std::int64_t{0}, std::int64_t{1}, -1 + Call(world(), function)[i].integer}) {
      Call call(world(), function);
      const std::int64_t right = call[i].integer;
      call[i].integer = count;
      call.fill();
      const ifsm_status status = call.run();  // some counts have a meaning: half the parameters, fewer symbols
      if (status == IFSM_OK) {
        call.forget_handles();
        continue;
      }
      Statuses expected = bad_count;
      if (function.parameters[i - 1].kind == "bytes_in") expected.insert(IFSM_ERROR_FORMAT);
      std::set<std::string> blamed = {parameter.name, function.parameters[i - 1].name};
      for (const Parameter& other : function.parameters)  // which of two counts is wrong cannot be known
        if (other.kind == "count") blamed.insert(other.name);
      expect_refused(call, expected, blamed, text(parameter, std::to_string(count)));
      if (status == IFSM_ERROR_SHAPE && last_error().argument == parameter.name) {
        EXPECT_EQ(last_error().required, right) << function.name << ", " << parameter.name;
      }
    }
  });
}

TEST(Misuse, OutputArraysThatAreTooSmallAreRefusedWithTheCountNeeded) {
  for_each({"capacity"}, [](const Function& function, std::size_t i, const Parameter& parameter) {
    Call call(world(), function);
    const std::int64_t needed = call[i].integer;
    const std::string& array = function.parameters[i - 1].name;
    for (const std::int64_t capacity : {std::int64_t{0}, std::int64_t{1}, needed - 1}) {
      call[i].integer = capacity;
      expect_refused(call, {IFSM_ERROR_CAPACITY}, {array}, text(parameter, std::to_string(capacity)));
      EXPECT_EQ(last_error().required, needed) << function.name;
    }
    for (const std::int64_t capacity : {std::int64_t{-1}, least}) {
      call[i].integer = capacity;
      expect_refused(call, {IFSM_ERROR_RANGE}, {parameter.name, array}, text(parameter, std::to_string(capacity)));
    }
    call[i].integer = most;  // "at least this much", whatever the number
    expect_taken(call, text(parameter, std::to_string(most)));
  });
}

TEST(Misuse, NullAndZeroAskForTheCountAlone) {
  for_each({"capacity"}, [](const Function& function, std::size_t i, const Parameter& parameter) {
    Call call(world(), function);
    const std::int64_t needed = call[i].integer;
    call[i].integer = 0;
    call[i - 1].pointer = nullptr;
    call.fill();
    expect_taken(call, text(parameter, "0 and no array"));
    std::int64_t told = 0;
    std::memcpy(&told, call[i + 1].pointer, sizeof told);
    EXPECT_EQ(told, needed) << function.name;
  });
}

TEST(Misuse, UnknownNamesAreRefused) {
  for_each({"string"}, [](const Function& function, std::size_t i, const Parameter& parameter) {
    for (const std::string& name : {std::string(), std::string("no such name"), std::string(100'000, 'x'),
                                    std::string("%s%n%d"), std::string("\xff\xfe\x80")}) {
      Call call(world(), function);
      std::string copy = name;
      call[i].pointer = copy.data();
      expect_refused(call, {IFSM_ERROR_RANGE}, {parameter.name}, text(parameter, "'" + name.substr(0, 20) + "'"));
    }
  });
}

TEST(Misuse, StructSizesThatNoHeaderHasAreRefused) {
  for_each({"struct_out", "options_in"}, [](const Function& function, std::size_t i, const Parameter& parameter) {
    for (const std::uint32_t size : {0U, 1U, 4U, 0x7fffffffU, 0xffffffffU}) {
      Call call(world(), function);
      std::memcpy(call.buffer(i).data(), &size, sizeof size);
      expect_refused(call, {IFSM_ERROR_OPTIONS}, {parameter.name, "struct_size"},
                     text(parameter, "of struct_size " + std::to_string(size)));
    }
  });
  for_each({"size"}, [](const Function& function, std::size_t i, const Parameter& parameter) {
    for (const std::int64_t size : {0LL, 1LL, 4LL, 0x7fffffffLL, 0xffffffffLL}) {
      Call call(world(), function);
      call[i].integer = size;
      expect_refused(call, {IFSM_ERROR_OPTIONS}, {parameter.name}, text(parameter, std::to_string(size)));
    }
  });
}

TEST(Misuse, StructsOfNewerAndOlderHeadersAreTakenAndNothingBehindThemIsRead) {
  constexpr std::uint32_t tail = 16;
  for_each({"options_in"}, [](const Function& function, std::size_t i, const Parameter& parameter) {
    Call call(world(), function);
    const auto size = static_cast<std::uint32_t>(parameter.size) + tail;
    std::memcpy(call.buffer(i).data(), &size, sizeof size);
    expect_taken(call, text(parameter, "of a newer header"));
    call.buffer(i)[parameter.size + tail] = 1;  // behind the newer struct: not its affair
    expect_taken(call, text(parameter, "of a newer header, before other memory"));
    for (const std::uint32_t at : {0U, tail - 1}) {
      call.buffer(i)[parameter.size + at] = 1;
      expect_refused(call, {IFSM_ERROR_OPTIONS}, {parameter.name}, text(parameter, "with an unknown field set"));
      call.buffer(i)[parameter.size + at] = 0;
    }
    const std::uint32_t oldest = 8;
    std::memcpy(call.buffer(i).data(), &oldest, sizeof oldest);
    expect_understood(call, text(parameter, "of the oldest header"));
  });
  for_each({"struct_out"}, [](const Function& function, std::size_t i, const Parameter& parameter) {
    Call call(world(), function);
    const auto size = static_cast<std::uint32_t>(parameter.size) + tail;
    std::memcpy(call.buffer(i).data(), &size, sizeof size);
    expect_taken(call, text(parameter, "of a newer header"));
    const std::uint32_t oldest = 8;
    std::memcpy(call.buffer(i).data(), &oldest, sizeof oldest);
    call.fill();
    const std::vector<std::uint8_t> before = call.buffer(i);
    expect_taken(call, text(parameter, "of the oldest header"));
    EXPECT_TRUE(std::equal(before.begin() + oldest, before.end(), call.buffer(i).begin() + oldest))
        << function.name << " writes behind an older " << parameter.type;
  });
}

// One field of a struct that is handed in, set to something wrong.
void expect_field_refused(const Function& function, std::size_t i, const Field& field, const void* value,
                          const Statuses& expected, const std::string& wrong) {
  Call call(world(), function);
  std::uint8_t* start = call.buffer(i).data();
  if (function.parameters[i].type == "ifsm_keep_options" && field.name == "threshold") {
    const std::int32_t rule = IFSM_KEEP_THRESHOLD;  // the rule that reads it
    std::memcpy(start + offsetof(ifsm_keep_options, rule), &rule, sizeof rule);
  }
  std::memcpy(start + field.offset, value, field.size);
  expect_refused(call, expected, {field.name}, function.parameters[i].name + "." + field.name + " " + wrong);
}

TEST(Misuse, FieldsOutsideTheirRangeAreRefused) {
  for_each({"struct_in", "options_in"}, [](const Function& function, std::size_t i, const Parameter& parameter) {
    for (const Field& field : fields(parameter.type)) {
      const bool wide = field.size == sizeof(std::int64_t);
      if (field.kind == "count" || field.kind == "integer" || field.kind == "enum" || field.kind == "zero") {
        std::vector<std::int64_t> wrong = {std::stoll(field.low) - 1, wide ? least : INT32_MIN};
        if (!field.high.empty()) wrong.insert(wrong.end(), {std::stoll(field.high) + 1, wide ? most : INT32_MAX});
        if (field.kind == "count") wrong.insert(wrong.end(), {most, beyond_memory});
        Statuses expected = bad_number;
        if (field.kind == "count") expected = bad_count;
        if (field.kind == "zero") expected.insert(IFSM_ERROR_OPTIONS);
        for (const std::int64_t value : wrong)  // little-endian: the low bytes are the narrow number
          expect_field_refused(function, i, field, &value, expected, std::to_string(value));
      } else if (field.kind == "double") {
        for (const double value : {nan, infinity, -infinity})
          expect_field_refused(function, i, field, &value, {IFSM_ERROR_RANGE, IFSM_ERROR_NOT_FINITE},
                               std::to_string(value));
      } else if (field.kind == "handle") {
        const std::uint64_t stale = world().fresh(field.type);
        ASSERT_EQ(World::destroy(field.type, stale), IFSM_OK);
        std::vector<std::uint64_t> wrong = {stale, 1, ~std::uint64_t{0}};
        for (const auto& [type, id] : world().ids())
          if (type != field.type) wrong.push_back(id);
        for (const std::uint64_t id : wrong)
          expect_field_refused(function, i, field, &id, {IFSM_ERROR_INVALID_HANDLE}, std::to_string(id));
      } else if (field.kind == "doubles_in") {
        const void* null = nullptr;
        expect_field_refused(function, i, field, &null, {IFSM_ERROR_NULL}, "NULL");
      }
    }
  });
}

TEST(Misuse, CurvesWithOneBadCoordinateAreRefusedWithItsIndex) {
  for_each({"struct_in"}, [](const Function& function, std::size_t i, const Parameter&) {
    Call call(world(), function);
    std::vector<double>& points = call.curve_points();
    ASSERT_FALSE(call.buffer(i).empty());
    for (const std::size_t at : {std::size_t{0}, points.size() / 2, points.size() - 1}) {
      const double good = points[at];
      for (const double value : {nan, infinity, -infinity}) {
        points[at] = value;
        expect_refused(call, {IFSM_ERROR_NOT_FINITE}, {"points"}, "points that hold " + std::to_string(value));
        EXPECT_EQ(last_error().index, static_cast<std::int64_t>(at)) << function.name;
        EXPECT_FALSE(std::isfinite(last_error().value)) << function.name;
      }
      points[at] = good;
    }
  });
}

TEST(Misuse, BudgetsBelowOneAndTooManyOfThemAreRefused) {
  for_each({"options_in"}, [](const Function& function, std::size_t i, const Parameter& parameter) {
    if (parameter.type != "ifsm_fit_options") return;
    Call call(world(), function);
    ifsm_fit_options options;
    const auto set = [&](const std::int64_t* budgets, std::int64_t count) {
      std::memcpy(&options, call.buffer(i).data(), sizeof options);
      options.budgets = budgets, options.budget_count = count;
      std::memcpy(call.buffer(i).data(), &options, sizeof options);
    };
    for (const std::int64_t wrong : {std::int64_t{0}, std::int64_t{-1}, least}) {
      const std::int64_t budgets[] = {8, 6, wrong};
      set(budgets, 3);
      expect_refused(call, {IFSM_ERROR_RANGE}, {"budgets"}, "a budget of " + std::to_string(wrong));
      EXPECT_EQ(last_error().index, 2);
    }
    set(nullptr, 3);
    expect_refused(call, {IFSM_ERROR_NULL}, {"budgets"}, "budgets NULL, and a count");
  });
}

TEST(Misuse, LeavesAWorldInWhichEveryRightCallStillSucceeds) { every_right_call_succeeds(); }

TEST(ErrorRecord, IsNotClearedBySuccessNorByItself) {
  ASSERT_EQ(ifsm_set_threads(-1), IFSM_ERROR_RANGE);
  ASSERT_EQ(ifsm_set_threads(0), IFSM_OK);
  EXPECT_EQ(ifsm_last_error(nullptr), IFSM_ERROR_NULL);
  const ifsm_error error = last_error();
  EXPECT_EQ(error.status, IFSM_ERROR_RANGE);
  EXPECT_STREQ(error.function, "ifsm_set_threads");
  EXPECT_STREQ(error.argument, "threads");
  EXPECT_EQ(error.value, -1);
}

TEST(StatusName, IsTheConstantsNameForAllOfThemAndNeverNull) {
  for (const ifsm_status status : {INT32_MIN, -1, 17, 99, INT32_MAX})
    EXPECT_STREQ(ifsm_status_name(status), "unknown status");
  for (ifsm_status status = IFSM_OK; status <= IFSM_ERROR_INTERNAL; ++status)
    EXPECT_EQ(std::string(ifsm_status_name(status)).rfind("IFSM_", 0), 0U) << status;
  EXPECT_STREQ(ifsm_status_name(IFSM_OK), "IFSM_OK");
  EXPECT_STREQ(ifsm_status_name(IFSM_ERROR_INTERNAL), "IFSM_ERROR_INTERNAL");
}

}  // namespace
