# Every strong symbol that the installed libraries define carries limn's name, so that a program may link another copy
# of stb or tinyobjloader. Inline functions and templates of others are weak, and shared.

foreach(library core io)
    execute_process(COMMAND "${NM}" --defined-only --extern-only --demangle "${PREFIX}/lib/liblimn_${library}.a"
                    OUTPUT_VARIABLE listing COMMAND_ERROR_IS_FATAL ANY)
    string(REPLACE ";" "," listing "${listing}")
    string(REGEX MATCHALL "[0-9a-f]+ [TDBRC] [^\n]*" symbols "${listing}")
    if(NOT symbols)
        message(SEND_ERROR "liblimn_${library}.a defines nothing")
    endif()
    foreach(symbol IN LISTS symbols)
        if(NOT symbol MATCHES "^[0-9a-f]+ . ((non-virtual thunk to|vtable for|typeinfo for|typeinfo name for) )?limn(::|_)")
            message(SEND_ERROR "liblimn_${library}.a defines ${symbol}")
        endif()
    endforeach()
endforeach()
