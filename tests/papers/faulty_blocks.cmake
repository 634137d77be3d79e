# extract_blocks must find the faults of this paper, which it writes to FOLDER.

cmake_policy(VERSION 3.21)
include("${CMAKE_CURRENT_LIST_DIR}/extract.cmake")
file(WRITE "${FOLDER}/faulty.md" [==[
```
no language
```

```ruby
print("unknown language")
```

   ```text
indented
   ```

```cpp
return;  // no end
]==])
extract_blocks("${FOLDER}/faulty.md" "${FOLDER}")
set(expected "faulty: a fence that is indented or made of tildes" "faulty:2: unknown language ''"
    "faulty:6: unknown language 'ruby'" "faulty: block 3 has no end")
if(NOT "${faults}" STREQUAL "${expected}")
    message(FATAL_ERROR "found: ${faults}\nexpected: ${expected}")
endif()
