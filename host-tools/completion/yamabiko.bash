# bash completion for yamabiko. Verbs and options are what the command's own --help says.

_yamabiko()
{
    local command=$1 word=$2 before=$3 verb='' i values=''
    for ((i = 1; i < COMP_CWORD; i++)); do
        if [[ ${COMP_WORDS[i]} != -* ]]; then
            verb=${COMP_WORDS[i]}
            break
        fi
    done

    if [[ -z $verb ]]; then
        values="--help --version $("$command" --help 2>/dev/null | sed -n 's/^  \([a-z]*\) .*/\1/p')"
        mapfile -t COMPREPLY < <(compgen -W "$values" -- "$word")
        return
    fi

    case $before in
    --bus) values='gpiod spidev' ;;
    --format) values='grey4 rgb565 mono' ;;
    --palette) values='natural hypsometric mono night' ;;
    --shadows) values='16 32 64 128 256' ;;
    --panel) values=$("$command" info --panel 2>/dev/null | awk 'NR > 2 { print $1 }') ;;
    --profile) values=paper ;;
    --stage) values='contours links triangles' ;;
    --turn) values='0 90 180 270' ;;
    --view)
        values='orbit-45 orbit-135 orbit-225 orbit-315 summit-1 summit-2 walk-1 walk-2'
        ;;
    --walls) values='on off' ;;
    esac
    if [[ -z $values && $word == -* ]]; then
        values=$("$command" "$verb" --help 2>/dev/null |
            grep -oE -- "--[a-z][a-z-]*" | sort -u) || true
    fi

    if [[ -n $values ]]; then
        mapfile -t COMPREPLY < <(compgen -W "$values" -- "$word")
    else
        compopt -o filenames 2>/dev/null || true # only in a real completion
        mapfile -t COMPREPLY < <(compgen -f -- "$word")
    fi
}

complete -F _yamabiko yamabiko
